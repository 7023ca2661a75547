// What a key frame shows of the objects in a room.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dynamics/class_policy.h"
#include "ofm/objects/depth_sketch.h"
#include "ofm/objects/object_options.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

/// A key frame's images with its instances. The images are shared, not copied.
struct InstanceFrame {
  KeyframeId id;
  std::int64_t stamp_ns = 0;
  cv::Mat color;         ///< CV_8UC3, BGR
  cv::Mat depth_m;       ///< CV_32FC1 [m], 0 = not measured
  cv::Mat dynamic_mask;  ///< CV_8UC1, 255 = moves; may be empty
  std::vector<Instance> instances;
};

/// One instance as a small cloud in its camera's frame.
struct ObjectObservation {
  ClassId class_id;
  float score = 0;
  std::vector<Eigen::Vector3f> points_in_camera;  ///< [m]
  Rgb color;                                      ///< mean
  std::size_t instance = 0;                       ///< its place among the frame's instances
};

/// What is kept of a key frame; it stays good whatever becomes of the key frame's pose.
struct KeyframeObjects {
  std::int64_t stamp_ns = 0;
  DepthSketch depth;
  std::vector<ObjectObservation> observations;  ///< in the order of the instances
};

/// Makes them for one camera.
class ObjectObserver {
 public:
  ObjectObserver(const PinholeCamera& camera, const ObjectObservationOptions& options,
                 const ClassPolicies& policies);

  /// Each instance's steady surface: its mask a little smaller and trimmed by depth, without depth
  /// edges and flying pixels, one point per voxel. Left out are instances of classes that may move,
  /// and those that mostly do.
  KeyframeObjects Observe(const InstanceFrame& frame) const;

 private:
  bool StandsStill(const Instance& instance, const cv::Mat& dynamic_mask) const;
  ObjectObservation ObserveInstance(const Instance& instance, const InstanceFrame& frame,
                                    const cv::Mat& smooth) const;

  PinholeCamera camera_;
  ObjectObservationOptions options_;
  ClassPolicies policies_;
  UndistortionTable ideal_px_;
};

}  // namespace ofm
