// Exact optical flow of the simulated world.
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/geometry/rigid_transform.h"
#include "ofm/sim/renderer.h"
#include "ofm/sim/scene.h"

namespace ofm {

/// A moment of the scene and the camera's place in it.
struct SceneView {
  double time_s = 0;
  RigidTransform world_from_camera;
};

/// Where what each pixel of `from` shows goes until `to`: CV_32FC2, (x, y) [px], lens distortion
/// included; NaN where nothing is seen or where it goes behind the camera. What is hidden in `to`
/// has a flow too.
cv::Mat RenderFlow(const Renderer& renderer, const Scene& scene, const SceneView& from,
                   const SceneView& to);

/// As 16-bit PNGs of the KITTI benchmark have it: CV_16UC3 whose channels are, in OpenCV's order,
/// valid (0 or 1), 64 y + 2^15 and 64 x + 2^15. Flow beyond 511 px is not valid.
cv::Mat EncodeFlow(const cv::Mat& flow);

/// Inverse of EncodeFlow, to 1/128 px; NaN where it is not valid.
cv::Mat DecodeFlow(const cv::Mat& encoded);

}  // namespace ofm
