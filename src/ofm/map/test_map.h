// Features without images, keyframes and a check of the map, for tests of this module and of those
// above it.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/map/map.h"

namespace ofm::test {

/// A feature as a test wants it.
struct TestFeature {
  Eigen::Vector2f ideal_px = Eigen::Vector2f(320, 240);
  float depth_m = 2;
  int octave = 0;
  Descriptor descriptor{};
  float angle_rad = 0;
};

inline OctaveScales TestScales() { return {8, 1.2}; }

inline Descriptor RandomDescriptor(RandomEngine& engine) {
  return {engine(), engine(), engine(), engine()};
}

/// `descriptor` with `count` bits changed, from bit `first` on.
inline Descriptor FlipBits(Descriptor descriptor, int count, int first = 0) {
  for (int i = first; i < first + count; ++i) descriptor[i / 64] ^= std::uint64_t{1} << (i % 64);
  return descriptor;
}

inline std::shared_ptr<const FrameFeatures> MakeTestFeatures(
    const std::vector<TestFeature>& features, const PinholeCamera& camera = {}) {
  auto frame = std::make_shared<FrameFeatures>();
  for (const TestFeature& f : features) {
    frame->keypoints.push_back({f.ideal_px, f.octave, f.angle_rad, 1});
    frame->descriptors.push_back(f.descriptor);
    frame->ideal_px.push_back(f.ideal_px);
    frame->depth_m.push_back(f.depth_m);
  }
  frame->grid = FeatureGrid(frame->ideal_px, camera.width, camera.height);
  return frame;
}

/// The feature by which a camera sees `point_in_camera`.
inline TestFeature SeePoint(const Eigen::Vector3d& point_in_camera, const Descriptor& descriptor,
                            int octave = 0, const PinholeCamera& camera = {}) {
  const Eigen::Vector2d pixel = camera.ProjectIdeal(point_in_camera);
  return {pixel.cast<float>(), static_cast<float>(point_in_camera.z()), octave, descriptor, 0};
}

/// A keyframe that names no landmark.
inline Keyframe MakeTestKeyframe(std::shared_ptr<const FrameFeatures> features,
                                 const RigidTransform& camera_from_world = {}) {
  Keyframe keyframe;
  keyframe.landmarks.resize(features->size());
  keyframe.features = std::move(features);
  keyframe.camera_from_world = camera_from_world;
  return keyframe;
}

/// A keyframe of `count` features that are alike.
inline Keyframe MakePlainKeyframe(int count, const RigidTransform& camera_from_world = {}) {
  return MakeTestKeyframe(MakeTestFeatures(std::vector<TestFeature>(count)), camera_from_world);
}

/// camera_from_world of a camera at (x, y, z) with the world's axes.
inline RigidTransform CameraAt(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(-x, -y, -z)};
}

inline double MaxDifference(const RigidTransform& a, const RigidTransform& b) {
  return std::max((a.RotationMatrix() - b.RotationMatrix()).cwiseAbs().maxCoeff(),
                  (a.translation() - b.translation()).cwiseAbs().maxCoeff());
}

/// What is wrong with a landmark of `keyframes`; empty where nothing is.
template <class FindKeyframe>
std::string FindLandmarkProblem(const Landmark& landmark, FindKeyframe&& find_keyframe) {
  const std::string name = "landmark " + std::to_string(landmark.id.value) + ": ";
  if (landmark.observations.empty()) return name + "no observations";
  KeyframeId before;
  SubmapId submap;
  for (const Landmark::Observation& o : landmark.observations) {
    if (before.valid() && !(before < o.keyframe)) return name + "observations out of order";
    before = o.keyframe;
    const Keyframe* keyframe = find_keyframe(o.keyframe);
    if (keyframe == nullptr) return name + "seen by a keyframe that is gone";
    if (keyframe->landmarks.at(o.feature) != landmark.id) {
      return name + "keyframe " + std::to_string(o.keyframe.value) + " names another one";
    }
    if (submap.valid() && keyframe->submap != submap) return name + "seen from two sub-maps";
    submap = keyframe->submap;
  }
  return {};
}

/// The same for a keyframe.
template <class FindLandmark>
std::string FindKeyframeProblem(const Keyframe& keyframe, FindLandmark&& find_landmark) {
  const std::string name = "keyframe " + std::to_string(keyframe.id.value) + ": ";
  if (keyframe.landmarks.size() != keyframe.features->size()) return name + "wrong size";
  std::set<LandmarkId> named;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const LandmarkId id = keyframe.landmarks[i];
    if (!id.valid()) continue;
    if (!named.insert(id).second) return name + "names a landmark twice";
    const Landmark* landmark = find_landmark(id);
    if (landmark == nullptr) return name + "names a landmark that is gone";
    if (landmark->FeatureIn(keyframe.id) != static_cast<int>(i)) {
      return name + "landmark " + std::to_string(id.value) + " does not name the feature";
    }
  }
  return {};
}

/// Where keyframes and landmarks contradict one another; empty where they do not.
inline std::string FindProblem(const Map& map) {
  std::string problem;
  map.landmarks().ForEach([&](const Landmark& landmark) {
    if (problem.empty()) {
      problem = FindLandmarkProblem(landmark, [&](KeyframeId id) { return map.FindKeyframe(id); });
    }
  });
  map.keyframes().ForEach([&](const Keyframe& keyframe) {
    if (problem.empty()) {
      problem =
          FindKeyframeProblem(keyframe, [&](LandmarkId id) { return map.landmarks().Find(id); });
    }
  });
  return problem;
}

inline std::string FindProblem(const MapSnapshot& map) {
  std::string problem;
  std::size_t landmarks = 0, keyframes = 0;
  map.landmarks.ForEach([&](const Landmark& landmark) {
    ++landmarks;
    if (problem.empty()) {
      problem =
          FindLandmarkProblem(landmark, [&](KeyframeId id) { return map.keyframes.Find(id); });
    }
  });
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    ++keyframes;
    if (problem.empty()) {
      problem =
          FindKeyframeProblem(keyframe, [&](LandmarkId id) { return map.landmarks.Find(id); });
    }
  });
  if (landmarks != map.landmark_count || keyframes != map.keyframe_count) problem = "wrong counts";
  return problem;
}

/// True where the numbers are the same to the last bit, but for the sign of zeros.
inline bool IsSame(const RigidTransform& a, const RigidTransform& b) {
  return a.rotation().coeffs() == b.rotation().coeffs() && a.translation() == b.translation();
}

inline bool IsSame(const FrameFeatures& a, const FrameFeatures& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Keypoint &ka = a.keypoints[i], &kb = b.keypoints[i];
    if (ka.pixel != kb.pixel || ka.octave != kb.octave || ka.angle_rad != kb.angle_rad ||
        ka.response != kb.response || a.StaticProbability(i) != b.StaticProbability(i)) {
      return false;
    }
  }
  return a.descriptors == b.descriptors && a.ideal_px == b.ideal_px && a.depth_m == b.depth_m;
}

inline bool IsSame(const Landmark& a, const Landmark& b) {
  const auto seen = [](const Landmark& landmark) {
    std::vector<std::pair<KeyframeId, int>> list;
    for (const Landmark::Observation& o : landmark.observations) {
      list.emplace_back(o.keyframe, o.feature);
    }
    return list;
  };
  const auto rest = [](const Landmark& l) {
    return std::tuple(l.id, l.descriptor, l.min_distance_m, l.max_distance_m, l.first_keyframe,
                      l.visible_count, l.found_count, l.static_probability);
  };
  return a.position_in_world == b.position_in_world && a.mean_view == b.mean_view &&
         seen(a) == seen(b) && rest(a) == rest(b);
}

inline bool IsSame(const Keyframe& a, const Keyframe& b) {
  return a.id == b.id && a.stamp_ns == b.stamp_ns && a.submap == b.submap &&
         a.landmarks == b.landmarks && IsSame(a.camera_from_world, b.camera_from_world) &&
         IsSame(*a.features, *b.features);
}

template <class Id, class T>
bool IsSame(const TableSnapshot<Id, T>& a, const TableSnapshot<Id, T>& b) {
  if (a.ids_issued() != b.ids_issued()) return false;
  for (std::uint32_t i = 0; i < a.ids_issued(); ++i) {
    const T *in_a = a.Find(Id(i)), *in_b = b.Find(Id(i));
    if ((in_a == nullptr) != (in_b == nullptr)) return false;
    if (in_a != nullptr && !IsSame(*in_a, *in_b)) return false;
  }
  return true;
}

/// In what two maps differ, the frames of their keyframes left out; empty where in nothing.
inline std::string FindDifference(const MapSnapshot& a, const MapSnapshot& b) {
  if (!IsSame(a.keyframes, b.keyframes)) return "keyframes";
  if (!IsSame(a.landmarks, b.landmarks)) return "landmarks";
  if (a.replacements != b.replacements) return "replacements";
  if (a.latest_keyframe != b.latest_keyframe) return "latest keyframe";
  if (a.keyframe_count != b.keyframe_count || a.landmark_count != b.landmark_count) return "counts";
  const auto same_anchor = [](const auto& x, const auto& y) {
    return x.first == y.first && x.second.keyframe == y.second.keyframe &&
           IsSame(x.second.removed_from_keyframe, y.second.removed_from_keyframe);
  };
  const bool same_anchors = std::equal(a.anchors.begin(), a.anchors.end(), b.anchors.begin(),
                                       b.anchors.end(), same_anchor);
  return same_anchors ? "" : "anchors";
}

}  // namespace ofm::test
