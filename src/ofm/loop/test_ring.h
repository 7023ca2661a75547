// A round room whose landmarks a camera sees in turn, and the map that odometry with drift makes of
// it: what was out of sight and comes back is a new landmark. For the tests of this module.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "ofm/features/default_vocabulary.h"
#include "ofm/features/static_words.h"
#include "ofm/map/test_map.h"
#include "ofm/sim/normal_deviate.h"
#include "ofm/tracking/measurement.h"

namespace ofm::test {

struct RingOptions {
  std::uint64_t seed = 1;
  int landmarks = 1500;
  int keyframes_per_round = 24;
  double drift_m = 0.01, drift_rad = 0.004;  ///< standard deviation of each step's error
  double bias_rad = 0;                       ///< by which each step turns too far
  double pixel_sigma = 0.5;                  ///< [px]
  int descriptor_noise_bits = 4;             ///< in each view, at random places
};

class RingWorld {
 public:
  explicit RingWorld(const RingOptions& options = {}) : options_(options) {
    RandomEngine engine = MakeRandomEngine(options.seed, 0);
    for (int i = 0; i < options.landmarks; ++i) {
      const double angle = 2 * M_PI * UniformReal(engine), radius = 2.5 + UniformReal(engine);
      const double height = 2.4 * UniformReal(engine) - 1.2;
      points_.emplace_back(radius * std::sin(angle), height, radius * std::cos(angle));
      descriptors_.push_back(RandomDescriptor(engine));
    }
  }

  struct View {
    std::shared_ptr<const FrameFeatures> features;
    std::vector<int> shown;  ///< the world's landmark, by feature
  };

  MeasurementModel model() const { return {camera_, TestScales(), {}}; }
  /// camera_from_world of keyframe `i`: half a metre from the middle, looking outwards.
  RigidTransform Truth(int i) const {
    const double angle = 2 * M_PI * i / options_.keyframes_per_round;
    const RigidTransform world_from_camera(ExpSo3({0, angle, 0}),
                                           {0.5 * std::sin(angle), 0, 0.5 * std::cos(angle)});
    return world_from_camera.Inverse();
  }
  View Look(int i) const {
    RandomEngine engine = MakeRandomEngine(options_.seed, 1 + i);
    View view;
    std::vector<TestFeature> features;
    const RigidTransform pose = Truth(i);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const Eigen::Vector3d point = pose * points_[p];
      if (point.z() < 0.5) continue;
      TestFeature feature = SeePoint(point, descriptors_[p], 0, camera_);
      const double du = NormalDeviate(engine), dv = NormalDeviate(engine);
      feature.ideal_px += static_cast<float>(options_.pixel_sigma) *
                          Eigen::Vector2f(static_cast<float>(du), static_cast<float>(dv));
      for (int bit = 0; bit < options_.descriptor_noise_bits; ++bit) {
        const auto place = static_cast<int>(UniformIndex(engine, 256));
        feature.descriptor = FlipBits(feature.descriptor, 1, place);
      }
      if (!camera_.IsInImage(feature.ideal_px.cast<double>())) continue;
      features.push_back(feature);
      view.shown.push_back(static_cast<int>(p));
    }
    view.features = MakeTestFeatures(features, camera_);
    return view;
  }
  RigidTransform DriftOf(int i) const {
    RandomEngine engine = MakeRandomEngine(options_.seed, 100000 + i);
    Vector6d twist;
    for (int k = 0; k < 6; ++k) {
      twist[k] = (k < 3 ? options_.drift_m : options_.drift_rad) * NormalDeviate(engine);
    }
    twist[4] += options_.bias_rad;
    return ExpSe3(twist);
  }

 private:
  RingOptions options_;
  PinholeCamera camera_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> descriptors_;
};

/// The map of a camera on its way round.
class RingMap {
 public:
  explicit RingMap(const RingOptions& options = {}) : world(options) {}

  /// Keyframes [first, end) of the way.
  void AddUpTo(int end) {
    while (next_ < end) Add(next_++);
  }
  /// The next keyframe knows nothing of those before: it begins a sub-map, at `camera_from_world`.
  void BeginSubmap(const RigidTransform& camera_from_world) {
    begin_ = camera_from_world;
    last_ = KeyframeId();
    name_of_.clear();
  }
  KeyframeId Add(int i) {
    const RingWorld::View view = world.Look(i);
    Keyframe keyframe = MakeTestKeyframe(view.features);
    keyframe.stamp_ns = i;
    keyframe.words =
        std::make_shared<const BagOfWords>(StaticWords(*view.features, DefaultVocabulary()));
    keyframe.camera_from_world = world.Truth(i);
    if (begin_) keyframe.camera_from_world = *begin_, keyframe.submap = SubmapId();
    begin_.reset();
    if (last_.valid()) {
      keyframe.submap = map.FindSubmap(last_);
      keyframe.camera_from_world = world.DriftOf(i) * world.Truth(i) *
                                   world.Truth(i - 1).Inverse() *
                                   map.GetKeyframe(last_).camera_from_world;
    }
    const RigidTransform world_from_camera = keyframe.camera_from_world.Inverse();
    for (std::size_t f = 0; f < view.shown.size(); ++f) {
      const auto name = name_of_.find(view.shown[f]);
      if (name != name_of_.end()) keyframe.landmarks[f] = name->second;
    }
    last_ = map.AddKeyframe(std::move(keyframe));
    name_of_.clear();
    for (std::size_t f = 0; f < view.shown.size(); ++f) {
      const int feature = static_cast<int>(f);
      LandmarkId id = map.GetKeyframe(last_).landmarks[f];
      if (!id.valid()) {
        const auto point = PointInCamera(*view.features, feature, world.model().camera);
        id = map.AddLandmark(world_from_camera * *point, last_, feature);
      }
      map.RefreshLandmark(id);
      name_of_[view.shown[f]] = id;
    }
    return last_;
  }

  /// Distance of a keyframe's centre from the truth [m].
  double Error_m(KeyframeId id) const {
    const Keyframe& keyframe = map.GetKeyframe(id);
    const RigidTransform truth = world.Truth(static_cast<int>(keyframe.stamp_ns));
    return (keyframe.CenterInWorld() - truth.Inverse().translation()).norm();
  }
  /// Root mean square of all.
  double RmsError_m() const {
    double sum = 0;
    map.keyframes().ForEach([&](const Keyframe& k) { sum += std::pow(Error_m(k.id), 2); });
    return std::sqrt(sum / static_cast<double>(map.keyframes().size()));
  }

  RingWorld world;
  Map map{TestScales()};

 private:
  int next_ = 0;
  KeyframeId last_;
  std::optional<RigidTransform> begin_;
  std::map<int, LandmarkId> name_of_;  // of the world's landmarks that the last keyframe showed
};

}  // namespace ofm::test
