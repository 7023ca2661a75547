#include "ofm/mapping/mapper.h"

#include <algorithm>

#include "ofm/features/static_words.h"
#include "ofm/mapping/keyframe_culling.h"
#include "ofm/mapping/landmark_fusion.h"
#include "ofm/mapping/landmark_triangulation.h"
#include "ofm/mapping/map_adjustment.h"

namespace ofm {
namespace {

/// For as many keyframes after the one that made it, a landmark can be culled.
constexpr std::uint32_t kTrialKeyframes = 3;

}  // namespace

Mapper::Mapper(const MeasurementModel& model, const MappingOptions& options,
               const MapSnapshot& start)
    : model_(model), options_(options), map_(model.scales, start) {
  // The landmarks of the newest keyframes are still on trial.
  map_.landmarks().ForEach([&](const Landmark& landmark) {
    if (landmark.first_keyframe.value + kTrialKeyframes > map_.latest_keyframe().value) {
      young_.push_back({landmark.id, landmark.first_keyframe});
    }
  });
}

KeyframeId Mapper::Insert(const KeyframeCandidate& candidate,
                          const std::vector<Sighting>& sightings) {
  for (const Sighting& sighting : sightings) {
    map_.CountSightings(sighting.landmark, 1, sighting.found ? 1 : 0);
    if (sighting.static_probability) {
      map_.UpdateStaticProbability(sighting.landmark, *sighting.static_probability);
    }
  }
  RemoveMoving(sightings);
  Keyframe keyframe;
  keyframe.frame_id = candidate.frame_id;
  keyframe.stamp_ns = candidate.stamp_ns;
  keyframe.features = candidate.features;
  keyframe.words =
      std::make_shared<const BagOfWords>(StaticWords(*candidate.features, map_.vocabulary()));
  keyframe.landmarks = candidate.landmarks;
  keyframe.camera_from_world = candidate.camera_from_world;
  // The reference may have been adjusted, or removed, since the candidate was tracked against it.
  const auto reference_pose = map_.FindKeyframePose(candidate.reference);
  if (reference_pose) {
    keyframe.camera_from_world = candidate.camera_from_reference * *reference_pose;
  }
  if (candidate.begins_submap) {
    keyframe.submap = SubmapId();
  } else if (reference_pose) {
    keyframe.submap = map_.FindSubmap(candidate.reference);
  }
  const KeyframeId id = map_.AddKeyframe(std::move(keyframe));
  const std::vector<LandmarkId> seen = map_.GetKeyframe(id).landmarks;
  for (const LandmarkId landmark : seen) {
    if (landmark.valid()) map_.RefreshLandmark(landmark);
  }
  CreateFromDepth(id);
  return id;
}

/// Landmarks that the sightings have shown to move.
void Mapper::RemoveMoving(const std::vector<Sighting>& sightings) {
  for (const Sighting& sighting : sightings) {
    const Landmark* landmark = map_.FindLandmark(sighting.landmark);
    const bool moves =
        landmark != nullptr && landmark->static_probability < options_.min_static_probability;
    if (moves) map_.RemoveLandmark(landmark->id);
  }
}

void Mapper::CreateFromDepth(KeyframeId id) {
  const Keyframe& keyframe = map_.GetKeyframe(id);
  const std::shared_ptr<const FrameFeatures> features = keyframe.features;
  const RigidTransform world_from_camera = keyframe.camera_from_world.Inverse();
  std::vector<int> order;
  for (std::size_t i = 0; i < features->size(); ++i) {
    if (features->depth_m[i] > 0) order.push_back(static_cast<int>(i));
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return features->depth_m[a] < features->depth_m[b]; });
  int close = 0;
  for (const int feature : order) {
    if (features->depth_m[feature] > model_.CloseDepth() && close >= options_.min_close_landmarks) {
      break;
    }
    ++close;
    if (map_.GetKeyframe(id).landmarks[feature].valid()) continue;
    const Eigen::Vector3d point = *PointInCamera(*features, feature, model_.camera);
    young_.push_back({map_.AddLandmark(world_from_camera * point, id, feature), id});
  }
}

void Mapper::CullYoung(KeyframeId current) {
  const SubmapId submap = map_.FindSubmap(current);
  std::erase_if(young_, [&](const YoungLandmark& young) {
    const Landmark* landmark = map_.landmarks().Find(young.id);
    if (landmark == nullptr) return true;
    // Keyframes of another sub-map say nothing of it: its trial goes on once the camera is back.
    if (map_.FindSubmap(young.made_by) != submap) return false;
    const std::uint32_t age = current.value - young.made_by.value;
    const bool rarely_found =
        landmark->found_count < options_.min_found_ratio * landmark->visible_count;
    const bool rarely_seen =
        age >= 2 && static_cast<int>(landmark->observations.size()) < options_.min_observations;
    if (rarely_found || rarely_seen) {
      map_.RemoveLandmark(young.id);
      return true;
    }
    return age >= kTrialKeyframes;
  });
}

void Mapper::Refine(std::stop_token stop) {
  const KeyframeId current = map_.latest_keyframe();
  if (!current.valid()) return;
  CullYoung(current);
  for (const LandmarkId id : TriangulateWithNeighbours(map_, current, model_, options_)) {
    young_.push_back({id, current});
  }
  FuseWithNeighbours(map_, current, model_, options_);
  if (map_.keyframes().size() > 1 && !stop.stop_requested()) {
    AdjustLocally(map_, current, model_, options_, stop);
  }
  RemoveRedundantKeyframes(map_, current, model_, options_);
  RemoveKeyframesOverBudget(map_, current, model_, options_);
}

CorrectionReport Mapper::Apply(const MapCorrection& correction) {
  return ApplyCorrection(correction, map_);
}

void Mapper::AdjustAll(std::stop_token stop) {
  if (map_.keyframes().size() > 1) AdjustWholeMap(map_, model_, options_, stop);
}

}  // namespace ofm
