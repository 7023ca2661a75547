#include "ofm/objects/join_objects.h"

#include <algorithm>
#include <tuple>

#include "ofm/dense/voxel_filter.h"
#include "ofm/objects/object_association.h"

namespace ofm {
namespace {

constexpr double kBoxTrimShare = 0.02;

std::vector<PlacedObservation> PlaceObservations(KeyframeId id, const KeyframeObjects& keyframe,
                                                 const RigidTransform& world_from_camera) {
  std::vector<PlacedObservation> placed;
  for (const ObjectObservation& seen : keyframe.observations) {
    PlacedObservation observation{id, keyframe.stamp_ns, seen.class_id, seen.score, seen.color,
                                  {}, seen.instance};
    for (const Eigen::Vector3f& point : seen.points_in_camera) {
      observation.points_in_world.push_back(
          (world_from_camera * point.cast<double>().eval()).cast<float>());
    }
    placed.push_back(std::move(observation));
  }
  return placed;
}

/// The key frames that take part, with their poses.
std::map<KeyframeId, RigidTransform> UsablePoses(const JoinInput& input) {
  std::map<KeyframeId, RigidTransform> poses;
  for (const auto& [id, keyframe] : input.keyframes) {
    const auto pose = input.world_from_camera.find(id);
    if (pose != input.world_from_camera.end() && pose->second.IsFinite()) poses.insert(*pose);
  }
  return poses;
}

/// Key frames that detected the object, and those that should have.
int CountExpectedViews(const ObjectHypothesis& hypothesis, const JoinInput& input,
                       const std::map<KeyframeId, RigidTransform>& poses,
                       const ObjectJoinOptions& options) {
  const std::vector<Eigen::Vector3f> centers = hypothesis.Centers();
  const double wanted = options.min_visible_share * static_cast<double>(centers.size());
  int expected = 0;
  for (const auto& [id, world_from_camera] : poses) {
    if (hypothesis.views().contains(id)) {
      ++expected;
      continue;
    }
    const PointSight sight =
        FindSight(centers, world_from_camera.Inverse(), input.keyframes.at(id).depth, input.camera,
                  {options.depth_tolerance_m, options.border_px});
    // Where the camera looks through, the object should have been in the way.
    if (sight.visible + sight.seen_through >= wanted) ++expected;
  }
  return expected;
}

std::vector<ClassProbability> Probabilities(const ObjectHypothesis& hypothesis) {
  std::vector<ClassProbability> classes;
  const double all = hypothesis.Weight();
  for (const auto& [id, weight] : hypothesis.class_weights()) classes.push_back({id, weight / all});
  std::stable_sort(classes.begin(), classes.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
  return classes;
}

Rgb MeanColor(const ObjectHypothesis& hypothesis) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double points = 0;
  for (const PlacedObservation& seen : hypothesis.observations()) {
    const auto count = static_cast<double>(seen.points_in_world.size());
    sum += count * Eigen::Vector3d(seen.color.r, seen.color.g, seen.color.b);
    points += count;
  }
  return points == 0 ? Rgb{} : ToRgb(sum / points);
}

/// Everything but id and views_expected, with the confidence's sum of scores.
SceneObject Describe(const ObjectHypothesis& hypothesis, const Eigen::Vector3d& up,
                     const ObjectOptions& options) {
  VoxelFilter filter(options.observation.point_spacing_m);
  for (const Eigen::Vector3f& point : hypothesis.Points()) filter.Add({point, {}, kNoLabel, 0});
  std::vector<Eigen::Vector3f> points;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const LabelledPoint& point : filter.Points()) {
    points.push_back(point.position);
    sum += point.position.cast<double>();
  }
  SceneObject object;
  object.classes = Probabilities(hypothesis);
  object.box = FitOrientedBox(points, up, kBoxTrimShare);
  if (!points.empty()) object.centroid_in_world = sum / static_cast<double>(points.size());
  object.first_seen_ns = object.last_seen_ns = hypothesis.observations().front().stamp_ns;
  for (const PlacedObservation& seen : hypothesis.observations()) {
    object.first_seen_ns = std::min(object.first_seen_ns, seen.stamp_ns);
    object.last_seen_ns = std::max(object.last_seen_ns, seen.stamp_ns);
    object.sightings.push_back({seen.keyframe, seen.instance});
  }
  object.views = static_cast<int>(hypothesis.views().size());
  for (const auto& [id, score] : hypothesis.views()) object.confidence += score;
  object.point_count = static_cast<int>(points.size());
  object.color = MeanColor(hypothesis);
  return object;
}

bool IsBefore(const SceneObject& a, const SceneObject& b) {
  const auto key = [](const SceneObject& object) {
    const Eigen::Vector3d& place = object.centroid_in_world;
    return std::make_tuple(object.first_seen_ns, object.class_id(), place.x(), place.y(),
                           place.z());
  };
  return key(a) < key(b);
}

}  // namespace

std::vector<SceneObject> JoinObjects(const JoinInput& input, const ObjectOptions& options) {
  const std::map<KeyframeId, RigidTransform> poses = UsablePoses(input);
  std::vector<ObjectHypothesis> hypotheses;
  for (const auto& [id, pose] : poses) {
    AssociateKeyframe(PlaceObservations(id, input.keyframes.at(id), pose), options.join,
                      hypotheses);
  }
  MergeHypotheses(options.join, hypotheses);
  DropParts(options.join, hypotheses);
  std::erase_if(hypotheses, [&](const ObjectHypothesis& hypothesis) {
    return hypothesis.views().size() < static_cast<std::size_t>(options.join.min_views);
  });
  MergeNear(options.join, hypotheses);

  std::vector<SceneObject> objects;
  for (const ObjectHypothesis& hypothesis : hypotheses) {
    SceneObject object = Describe(hypothesis, input.up_in_world, options);
    object.views_expected = CountExpectedViews(hypothesis, input, poses, options.join);
    object.confidence /= object.views_expected;
    if (object.confidence < options.join.min_confidence || object.point_count == 0) continue;
    objects.push_back(std::move(object));
  }
  std::stable_sort(objects.begin(), objects.end(), IsBefore);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].id = ObjectId(static_cast<std::uint32_t>(i));
  }
  return objects;
}

}  // namespace ofm
