// Maps of the made world with known truth, for the tests of this module.
#pragma once

#include <map>

#include "ofm/tracking/test_world.h"

namespace ofm::test {

/// Which landmarks of the map are which of the world.
class Association {
 public:
  /// The map's names for what a frame shows; invalid where the map has none yet.
  std::vector<LandmarkId> Names(const Map& map, const MadeFrame& frame) const {
    std::vector<LandmarkId> names;
    for (const LandmarkId shown : frame.shown) {
      const auto known = name_of_.find(shown);
      const Landmark* landmark =
          known == name_of_.end() ? nullptr : map.FindLandmark(known->second);
      names.push_back(landmark == nullptr ? LandmarkId() : landmark->id);
    }
    return names;
  }
  /// To be called with each new keyframe.
  void Learn(const Keyframe& keyframe, const MadeFrame& frame) {
    for (std::size_t i = 0; i < frame.shown.size(); ++i) {
      if (keyframe.landmarks[i].valid()) name_of_[frame.shown[i]] = keyframe.landmarks[i];
    }
  }
  /// By the world's landmark.
  const std::map<LandmarkId, LandmarkId>& names() const { return name_of_; }

 private:
  std::map<LandmarkId, LandmarkId> name_of_;
};

/// A map of the world's frames at their true poses, in which every landmark is one.
struct TrueMap {
  explicit TrueMap(const FeatureWorldOptions& options = DefaultWorld()) : world(options) {}

  KeyframeId Add(const MadeFrame& frame) {
    const KeyframeId id = AddWithDepth(map, world.model(), frame, frame.camera_from_world,
                                       association.Names(map, frame));
    association.Learn(map.GetKeyframe(id), frame);
    truth.push_back(frame.camera_from_world);
    return id;
  }
  void RefreshAll() {
    for (const auto& [shown, id] : association.names()) map.RefreshLandmark(id);
  }
  /// Root mean square distance of the keyframes' centres from the truth [m].
  double PoseError_m() const {
    double sum = 0;
    map.keyframes().ForEach([&](const Keyframe& k) {
      const double error = DistanceOfCentres_m(k.camera_from_world, truth[k.id.value]);
      sum += error * error;
    });
    return std::sqrt(sum / static_cast<double>(map.keyframes().size()));
  }
  /// The same of the landmarks.
  double PointError_m() const {
    double sum = 0;
    int count = 0;
    for (const auto& [shown, id] : association.names()) {
      const Landmark* landmark = map.FindLandmark(id);
      if (landmark == nullptr) continue;
      sum += (landmark->position_in_world - world.points()[shown.value]).squaredNorm();
      ++count;
    }
    return std::sqrt(sum / count);
  }

  FeatureWorld world;
  Map map{TestScales()};
  Association association;
  std::vector<RigidTransform> truth;  // by keyframe
};

/// The frame with other features: `change(FrameFeatures&)`.
template <class Change>
MadeFrame Changed(const MadeFrame& frame, Change&& change) {
  MadeFrame changed = frame;
  auto features = std::make_shared<FrameFeatures>(*frame.features);
  change(*features);
  changed.features = std::move(features);
  return changed;
}

}  // namespace ofm::test
