// Frames with depth and true poses for benchmarks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ofm/geometry/rigid_transform.h"
#include "ofm/io/tum_sequence.h"

namespace ofm {

struct RgbdSample {
  std::int64_t stamp_ns = 0;
  cv::Mat gray;     ///< CV_8UC1
  cv::Mat depth_m;  ///< CV_32FC1 [m], 0 = not measured
  RigidTransform world_from_camera;
};

/// What is needed to read the frames of a TUM RGB-D folder on demand.
class RgbdSampleSource {
 public:
  /// A folder with groundtruth.txt; where it is not there, a synthetic world.
  RgbdSampleSource(const std::filesystem::path& folder, const PinholeCamera& camera);

  bool is_real() const { return sequence_.has_value(); }
  int size() const { return static_cast<int>(entries_.size()); }
  const PinholeCamera& camera() const { return camera_; }
  RgbdSample Read(int index) const;

 private:
  struct Entry {
    std::size_t frame;  ///< of the sequence
    std::int64_t stamp_ns;
    RigidTransform world_from_camera;
  };
  void ReadFolder(const std::filesystem::path& folder);
  void MakeSyntheticPoses();

  PinholeCamera camera_;
  std::optional<RgbdSequence> sequence_;
  std::vector<Entry> entries_;
  cv::Mat texture_;  ///< of the synthetic wall
};

}  // namespace ofm
