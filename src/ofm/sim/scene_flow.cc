#include "ofm/sim/scene_flow.h"

#include <cmath>
#include <limits>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kStepsPerPixel = 64;
constexpr float kZero = 32768;

/// Target camera from source camera, for what is fixed to each part.
std::vector<RigidTransform> PartMotions(const Scene& scene, const SceneView& from,
                                        const SceneView& to) {
  std::vector<RigidTransform> motions;
  const RigidTransform to_from_world = to.world_from_camera.Inverse();
  for (const Body& body : scene.bodies()) {
    const std::vector<RigidTransform> before = WorldFromParts(body, from.time_s);
    const std::vector<RigidTransform> after = WorldFromParts(body, to.time_s);
    for (std::size_t k = 0; k < before.size(); ++k) {
      motions.push_back(to_from_world * after[k] * before[k].Inverse() * from.world_from_camera);
    }
  }
  return motions;
}

}  // namespace

cv::Mat RenderFlow(const Renderer& renderer, const Scene& scene, const SceneView& from,
                   const SceneView& to) {
  constexpr double kBehind_m = 1e-3;
  const PinholeCamera& camera = renderer.camera();
  const VisibleParts visible = renderer.RenderParts(scene, from.time_s, from.world_from_camera);
  const std::vector<RigidTransform> motions = PartMotions(scene, from, to);
  const UndistortionTable ideal(camera);
  cv::Mat flow(visible.part.size(), CV_32FC2, cv::Scalar::all(kNone));
  for (int y = 0; y < flow.rows; ++y) {
    const int* part = visible.part.ptr<int>(y);
    const float* depth = visible.depth_m.ptr<float>(y);
    for (int x = 0; x < flow.cols; ++x) {
      if (part[x] < 0) continue;
      const Eigen::Vector3d there =
          motions[part[x]] * camera.UnprojectIdeal(ideal.At(x, y).cast<double>(), depth[x]);
      if (there.z() < kBehind_m) continue;
      const Eigen::Vector2d pixel = camera.Project(there);
      flow.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x() - x),
                                  static_cast<float>(pixel.y() - y)};
    }
  }
  return flow;
}

cv::Mat EncodeFlow(const cv::Mat& flow) {
  OFM_CHECK(flow.type() == CV_32FC2);
  constexpr float kLimit_px = 511;
  cv::Mat encoded(flow.size(), CV_16UC3, cv::Scalar::all(0));
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec2f f = flow.at<cv::Vec2f>(y, x);
      if (!(std::abs(f[0]) <= kLimit_px && std::abs(f[1]) <= kLimit_px)) continue;
      encoded.at<cv::Vec3w>(y, x) = {1, cv::saturate_cast<ushort>(kStepsPerPixel * f[1] + kZero),
                                     cv::saturate_cast<ushort>(kStepsPerPixel * f[0] + kZero)};
    }
  }
  return encoded;
}

cv::Mat DecodeFlow(const cv::Mat& encoded) {
  OFM_CHECK(encoded.type() == CV_16UC3);
  cv::Mat flow(encoded.size(), CV_32FC2, cv::Scalar::all(kNone));
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec3w e = encoded.at<cv::Vec3w>(y, x);
      if (e[0] == 0) continue;
      flow.at<cv::Vec2f>(y, x) = {(static_cast<float>(e[2]) - kZero) / kStepsPerPixel,
                                  (static_cast<float>(e[1]) - kZero) / kStepsPerPixel};
    }
  }
  return flow;
}

}  // namespace ofm
