#include "ofm/objects/object_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "ofm/base/time.h"

namespace ofm {
namespace {

using Json = nlohmann::ordered_json;

double Rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json VectorJson(const Eigen::Vector3d& v) {
  return {Rounded(v.x()), Rounded(v.y()), Rounded(v.z())};
}

Json BoxJson(const OrientedBox& box) {
  const Eigen::Quaterniond& q = box.world_from_box;
  return {{"center_m", VectorJson(box.center_in_world)},
          {"world_from_box", {Rounded(q.x()), Rounded(q.y()), Rounded(q.z()), Rounded(q.w())}},
          {"size_m", VectorJson(box.size_m)}};
}

Json ObjectJson(const SceneObject& object, const std::vector<std::string>& names) {
  Json probabilities = Json::object();
  for (const ClassProbability& likely : object.classes) {
    probabilities[names[likely.class_id.value]] = Rounded(likely.probability);
  }
  return {{"id", object.id.value},
          {"class", names[object.class_id().value]},
          {"probabilities", probabilities},
          {"centroid_m", VectorJson(object.centroid_in_world)},
          {"box", BoxJson(object.box)},
          {"first_seen", FormatSeconds(object.first_seen_ns)},
          {"last_seen", FormatSeconds(object.last_seen_ns)},
          {"views", object.views},
          {"views_expected", object.views_expected},
          {"confidence", Rounded(object.confidence)},
          {"points", object.point_count},
          {"color", {object.color.r, object.color.g, object.color.b}}};
}

Json TrackJson(const ObjectTrack& track, const std::vector<std::string>& names) {
  Json points = Json::array();
  for (const TrackPoint& point : track.points) {
    points.push_back({{"stamp", FormatSeconds(point.stamp_ns)},
                      {"position_m", VectorJson(point.position_in_world)},
                      {"speed_m_s", Rounded(point.speed_m_s)}});
  }
  return {{"id", track.id.value},
          {"class", names[track.class_id.value]},
          {"score", Rounded(track.score)},
          {"points", points}};
}

}  // namespace

std::string ObjectsJson(const ObjectInventory& inventory) {
  Json json = {{"version", 1},
               {"frame", "world"},
               {"up", VectorJson(inventory.up_in_world)},
               {"objects", Json::array()},
               {"tracks", Json::array()}};
  for (const SceneObject& object : inventory.objects) {
    json["objects"].push_back(ObjectJson(object, inventory.class_names));
  }
  for (const ObjectTrack& track : inventory.tracks) {
    json["tracks"].push_back(TrackJson(track, inventory.class_names));
  }
  return json.dump(1) + "\n";
}

}  // namespace ofm
