// The made world of sim/landmark_world.h with features instead of bare observations: every landmark
// has a descriptor of its own and appears at an octave that its distance decides. For tests of this
// module and of mapping.
#pragma once

#include <algorithm>
#include <cmath>

#include "ofm/base/time.h"
#include "ofm/map/test_map.h"
#include "ofm/sim/landmark_world.h"
#include "ofm/sim/normal_deviate.h"
#include "ofm/tracking/measurement.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm::test {

struct FeatureWorldOptions {
  LandmarkWorldOptions landmarks;  ///< its noise and outliers are not used
  double pixel_sigma = 0;          ///< at octave 0 [px]
  double depth_sigma = 0;          ///< sigma of depth = this times z^2 [1/m]
  double depthless_share = 0;      ///< of the landmarks: their depth is never measured
  int descriptor_noise_bits = 0;   ///< in each frame, at random places
};

inline FeatureWorldOptions DefaultWorld() {
  FeatureWorldOptions options;
  options.landmarks.landmarks = 1200;
  options.landmarks.frames = 60;
  options.landmarks.rate_hz = 10;
  return options;
}

/// What a frame shows, and what it should.
struct MadeFrame {
  FrameId id;
  std::int64_t stamp_ns = 0;
  RigidTransform camera_from_world;  ///< the truth
  std::shared_ptr<const FrameFeatures> features;
  std::vector<LandmarkId> shown;  ///< by feature: the world's landmark (not a map's)
};

class FeatureWorld {
 public:
  explicit FeatureWorld(const FeatureWorldOptions& options = DefaultWorld())
      : options_(options), world_(options.landmarks) {
    RandomEngine engine = MakeRandomEngine(options.landmarks.seed, 1000000);
    for (std::size_t i = 0; i < points().size(); ++i) {
      descriptors_.push_back(RandomDescriptor(engine));
      reach_m_.push_back(3.5 + 2.5 * UniformReal(engine));
      has_depth_.push_back(UniformReal(engine) >= options.depthless_share);
    }
  }

  const std::vector<Eigen::Vector3d>& points() const { return world_.landmarks_in_world(); }
  MeasurementModel model() const { return {world_.camera(), TestScales(), {}}; }

  /// Frame `id` of the path.
  MadeFrame Frame(std::uint32_t id) const {
    const StampedPose pose = world_.Pose(FrameId(id));
    return Look(id, NanosecondsToSeconds(pose.stamp_ns), pose.world_from_camera.Inverse());
  }

  /// A frame of any pose.
  MadeFrame Look(std::uint32_t id, double time_s, const RigidTransform& camera_from_world) const {
    RandomEngine engine = MakeRandomEngine(options_.landmarks.seed, 1 + std::uint64_t{id});
    MadeFrame frame{FrameId(id), SecondsToNanoseconds(time_s), camera_from_world, {}, {}};
    std::vector<TestFeature> features;
    for (std::uint32_t i = 0; i < points().size(); ++i) {
      const Eigen::Vector3d point = camera_from_world * points()[i];
      if (point.z() < 0.3) continue;
      const auto octave = std::lround(std::log(reach_m_[i] / point.norm()) / std::log(1.2));
      if (octave < 0 || octave > 7) continue;
      TestFeature feature = SeePoint(point, descriptors_[i], static_cast<int>(octave));
      Disturb(engine, feature);
      if (!world_.camera().IsInImage(feature.ideal_px.cast<double>())) continue;
      if (!has_depth_[i]) feature.depth_m = 0;
      features.push_back(feature);
      frame.shown.emplace_back(i);
    }
    frame.features = MakeTestFeatures(features, world_.camera());
    return frame;
  }

 private:
  void Disturb(RandomEngine& engine, TestFeature& feature) const {
    const double sigma_px = options_.pixel_sigma * TestScales().Scale(feature.octave);
    feature.ideal_px.x() += static_cast<float>(sigma_px * NormalDeviate(engine));
    feature.ideal_px.y() += static_cast<float>(sigma_px * NormalDeviate(engine));
    feature.depth_m += static_cast<float>(options_.depth_sigma * feature.depth_m * feature.depth_m *
                                          NormalDeviate(engine));
    for (int i = 0; i < options_.descriptor_noise_bits; ++i) {
      feature.descriptor =
          FlipBits(feature.descriptor, 1, static_cast<int>(UniformIndex(engine, 256)));
    }
  }

  FeatureWorldOptions options_;
  LandmarkWorld world_;
  std::vector<Descriptor> descriptors_;
  std::vector<double> reach_m_;  // beyond which the landmark is too small, about
  std::vector<char> has_depth_;
};

inline TrackingInput MakeInput(const MadeFrame& frame, std::shared_ptr<const MapSnapshot> map) {
  TrackingInput input;
  input.frame_id = frame.id;
  input.stamp_ns = input.depth_stamp_ns = frame.stamp_ns;
  input.features = frame.features;
  input.map = std::move(map);
  return input;
}

/// A frame in which nothing is to be seen.
inline MadeFrame MakeBlindFrame(const MadeFrame& like) {
  MadeFrame frame = like;
  frame.features = MakeTestFeatures({});
  frame.shown.clear();
  return frame;
}

/// Adds a keyframe to `map`, with a landmark for every feature that has depth and names none.
inline KeyframeId AddWithDepth(Map& map, const MeasurementModel& model, Keyframe keyframe) {
  const auto features = keyframe.features;
  const RigidTransform world_from_camera = keyframe.camera_from_world.Inverse();
  const KeyframeId id = map.AddKeyframe(std::move(keyframe));
  for (std::size_t i = 0; i < features->size(); ++i) {
    const auto point = PointInCamera(*features, static_cast<int>(i), model.camera);
    if (!point || map.GetKeyframe(id).landmarks[i].valid()) continue;
    map.AddLandmark(world_from_camera * *point, id, static_cast<int>(i));
  }
  return id;
}

/// The same of a frame at `camera_from_world`.
inline KeyframeId AddWithDepth(Map& map, const MeasurementModel& model, const MadeFrame& frame,
                               const RigidTransform& camera_from_world,
                               const std::vector<LandmarkId>& landmarks = {}) {
  Keyframe keyframe = MakeTestKeyframe(frame.features, camera_from_world);
  keyframe.frame_id = frame.id;
  keyframe.stamp_ns = frame.stamp_ns;
  if (!landmarks.empty()) keyframe.landmarks = landmarks;
  return AddWithDepth(map, model, std::move(keyframe));
}

inline double DistanceOfCentres_m(const RigidTransform& a, const RigidTransform& b) {
  return (a.Inverse().translation() - b.Inverse().translation()).norm();
}

inline double AngleBetween_deg(const RigidTransform& a, const RigidTransform& b) {
  return (a * b.Inverse()).RotationAngle() * 180 / M_PI;
}

}  // namespace ofm::test
