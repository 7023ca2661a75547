// A made room of boxes, seen by a camera that knows every instance. Tests only.
#pragma once

#include <map>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "ofm/camera/depth_noise.h"
#include "ofm/dense/test_scene.h"
#include "ofm/dynamics/class_policy.h"
#include "ofm/objects/object_mapper.h"

namespace ofm::test {

constexpr std::uint8_t kTv = 62, kLaptop = 63, kBook = 73;
/// COCO's order, as far as tests go.
inline std::vector<std::string> ClassNames() {
  std::vector<std::string> names(80, "thing");
  names[kPerson] = "person", names[kChair] = "chair";
  names[kTv] = "tv", names[kLaptop] = "laptop", names[kBook] = "book";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "thing") names[i] += std::to_string(i);
  }
  return names;
}

inline ClassPolicies Policies(const DynamicsOptions& options = {}) {
  return {options, ClassNames()};
}

/// Everything with a class is an instance of score 0.9, numbered as in `boxes`.
inline InstanceFrame Look(const PinholeCamera& camera, const std::vector<Box>& boxes,
                          const RigidTransform& world_from_camera, KeyframeId id) {
  std::vector<Box> numbered = boxes;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].class_id != kNoLabel) numbered[i].class_id = static_cast<std::uint8_t>(i);
  }
  const LabelledFrame seen = Render(camera, numbered, world_from_camera, id);
  InstanceFrame frame{id, 1'000'000'000LL * id.value, seen.color, seen.depth_m.clone(), {}, {}};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].class_id == kNoLabel) continue;
    const cv::Mat mask = seen.class_ids == static_cast<int>(i);
    const cv::Rect box = cv::boundingRect(mask);
    if (box.empty()) continue;
    frame.instances.push_back(
        {InstanceId(static_cast<std::uint32_t>(i)), ClassId(boxes[i].class_id), 0.9F, box, mask});
  }
  return frame;
}

/// Adds the noise of a structured-light camera to its depth.
inline void AddNoise(InstanceFrame& frame, std::uint32_t seed) {
  std::mt19937 engine(seed);
  for (float& depth : cv::Mat_<float>(frame.depth_m)) {
    double sum = 0;  // of uniform numbers: nearly normal, and the same everywhere
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine()) / 4294967296.0;
    if (depth > 0) depth += static_cast<float>((sum - 6) * DepthSigma(depth));
  }
}

/// Poses along a line to the right, all looking ahead.
inline std::map<KeyframeId, RigidTransform> Walk(int steps, double from_x, double step_m) {
  std::map<KeyframeId, RigidTransform> poses;
  for (int i = 0; i < steps; ++i) {
    poses[KeyframeId(static_cast<std::uint32_t>(i))] = At(from_x + i * step_m, 0, 0);
  }
  return poses;
}

/// What noisy key frames at these poses saw.
inline std::map<KeyframeId, InstanceFrame> LookFrom(
    const std::map<KeyframeId, RigidTransform>& poses, const std::vector<Box>& boxes) {
  std::map<KeyframeId, InstanceFrame> frames;
  for (const auto& [id, pose] : poses) {
    frames[id] = Look(SmallCamera(), boxes, pose, id);
    AddNoise(frames[id], id.value);
  }
  return frames;
}

/// The objects that are made of frames.
inline std::vector<SceneObject> ObjectsOf(const std::map<KeyframeId, InstanceFrame>& frames,
                                          const std::map<KeyframeId, RigidTransform>& poses,
                                          const ObjectOptions& options = {}) {
  ObjectMapper mapper(SmallCamera(), options, Policies());
  for (const auto& [id, frame] : frames) mapper.AddKeyframe(frame);
  return mapper.Build(poses).objects;
}

}  // namespace ofm::test
