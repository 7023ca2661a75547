// Frames with depth and true poses for benchmarks.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct RgbdSample {
  cv::Mat gray;     ///< CV_8UC1
  cv::Mat depth_m;  ///< CV_32FC1 [m], 0 = not measured
  RigidTransform world_from_camera;
};

/// What is needed to read the frames of a TUM RGB-D folder on demand.
class RgbdSampleSource {
 public:
  /// A folder with associations.txt and groundtruth.txt; where it is not there, a synthetic world.
  RgbdSampleSource(const std::string& folder, const PinholeCamera& camera);

  bool is_real() const { return is_real_; }
  int size() const { return static_cast<int>(entries_.size()); }
  const PinholeCamera& camera() const { return camera_; }
  RgbdSample Read(int index) const;

 private:
  struct Entry {
    std::string color_path, depth_path;
    RigidTransform world_from_camera;
  };
  bool ReadFolder(const std::string& folder);
  void MakeSyntheticPoses();

  PinholeCamera camera_;
  std::vector<Entry> entries_;
  bool is_real_ = false;
  cv::Mat texture_;  ///< of the synthetic wall
};

}  // namespace ofm
