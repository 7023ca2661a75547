#include "ofm/report/scene_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "ofm/dense/label_color.h"
#include "ofm/report/hex_color.h"
#include "ofm/report/map_figure.h"
#include "ofm/report/text_encoding.h"

namespace ofm {
namespace {

using Json = nlohmann::ordered_json;

/// As report.css has them on light ground: a middle tone that shows on both.
constexpr std::array<const char*, kMaxRuns> kRunColors = {"#1f8fd6", "#e8711a", "#12ab80",
                                                          "#cf6fab", "#d39a1e", "#67b5e2"};

/// Axis-aligned box around places, cut into 65536 steps.
struct Quantizer {
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), step = Eigen::Vector3d::Ones();

  explicit Quantizer(const std::vector<Eigen::Vector3d>& places) {
    if (places.empty()) return;
    Eigen::Vector3d max = min = places.front();
    for (const Eigen::Vector3d& place : places) {
      min = min.cwiseMin(place), max = max.cwiseMax(place);
    }
    step = ((max - min) / 65535).cwiseMax(1e-9);
  }

  void Append(const Eigen::Vector3d& place, std::vector<unsigned char>& bytes) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto steps = static_cast<unsigned>(
          std::clamp(std::round((place[axis] - min[axis]) / step[axis]), 0., 65535.));
      bytes.push_back(static_cast<unsigned char>(steps & 255));
      bytes.push_back(static_cast<unsigned char>(steps >> 8));
    }
  }
};

Json VectorJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// What clouds and voxels share; `items` have color and class_id.
template <class Item>
Json PlacesToJson(const std::vector<Item>& items, const std::vector<Eigen::Vector3d>& places) {
  const Quantizer quantizer(places);
  std::vector<unsigned char> positions, colors, labels;
  for (std::size_t i = 0; i < items.size(); ++i) {
    quantizer.Append(places[i], positions);
    colors.insert(colors.end(), {items[i].color.r, items[i].color.g, items[i].color.b});
    labels.push_back(items[i].class_id);
  }
  return {{"count", items.size()},
          {"min", VectorJson(quantizer.min)},
          {"step", VectorJson(quantizer.step)},
          {"positions", EncodeBase64(positions)},
          {"colors", EncodeBase64(colors)},
          {"labels", EncodeBase64(labels)}};
}

/// So large that points of a surface touch where the cloud was thinned out.
double SpacingOf(const LabelledCloud& cloud) {
  constexpr double kVoxel_m = 0.02;
  const double kept =
      static_cast<double>(cloud.points.size()) / static_cast<double>(cloud.points_in_file);
  return std::clamp(kVoxel_m / std::sqrt(kept), 0.01, 0.1);
}

Json CloudToJson(const RunView& run) {
  const auto& cloud = run.record.cloud;
  if (!cloud || cloud->points.empty()) return nullptr;
  std::vector<Eigen::Vector3d> places;
  for (const LabelledPoint& point : cloud->points) {
    places.emplace_back(run.report_from_run * point.position.cast<double>());
  }
  Json json = PlacesToJson(cloud->points, places);
  json["spacing_m"] = SpacingOf(*cloud);
  return json;
}

Json VoxelsToJson(const RunView& run) {
  const auto& set = run.record.voxels;
  if (!set || set->voxels.empty()) return nullptr;
  std::vector<Eigen::Vector3d> places;
  std::vector<unsigned char> sizes;
  for (const LabelledVoxel& voxel : set->voxels) {
    places.emplace_back(voxel.center.cast<double>());
    sizes.push_back(voxel.size_exponent);
  }
  Json json = PlacesToJson(set->voxels, places);
  json["resolution_m"] = set->resolution_m;
  json["sizes"] = EncodeBase64(sizes);
  // Voxels stand along the axes of the run's own world.
  const Eigen::Matrix3d rotation = run.report_from_run.RotationMatrix();
  const Eigen::Vector3d& t = run.report_from_run.translation();
  json["report_from_run"] = {rotation(0, 0), rotation(0, 1), rotation(0, 2), t.x(),
                             rotation(1, 0), rotation(1, 1), rotation(1, 2), t.y(),
                             rotation(2, 0), rotation(2, 1), rotation(2, 2), t.z()};
  return json;
}

Json PathToJson(const Trajectory& trajectory) {
  if (trajectory.empty()) return nullptr;
  constexpr std::size_t kMostPoses = 5000;
  const std::size_t stride = (trajectory.size() + kMostPoses - 1) / kMostPoses;
  std::vector<unsigned char> bytes;
  for (std::size_t i = 0; i < trajectory.size(); i += stride) {
    const Eigen::Vector3f place = trajectory[i].world_from_camera.translation().cast<float>();
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof(float) * 3);
    std::memcpy(bytes.data() + end, place.data(), sizeof(float) * 3);
  }
  return EncodeBase64(bytes);
}

}  // namespace

nlohmann::ordered_json SceneToJson(const ReportData& data) {
  Json json = {{"up", VectorJson(data.plan.up)}, {"truth", PathToJson(data.truth)},
               {"truth_color", "#8a94a3"},       {"none_color", HexColor(kUnlabelledColor)},
               {"classes", Json::array()},       {"runs", Json::array()}};
  for (const auto& [id, name] : ClassesShown(data)) {
    json["classes"].push_back({{"id", id},
                               {"name", name},
                               {"color", HexColor(LabelColor(static_cast<std::uint8_t>(id)))}});
  }
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const RunView& run = data.runs[i];
    json["runs"].push_back({{"name", run.record.name},
                            {"color", kRunColors[i % kRunColors.size()]},
                            {"cloud", CloudToJson(run)},
                            {"voxels", VoxelsToJson(run)},
                            {"trajectory", PathToJson(run.trajectory)}});
  }
  return json;
}

}  // namespace ofm
