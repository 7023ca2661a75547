#include "ofm/features/frame_features.h"

#include <algorithm>
#include <cmath>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// The pixel of `image` nearest to a place.
cv::Point NearestPixel(const cv::Mat& image, const Eigen::Vector2f& place) {
  return {std::clamp(static_cast<int>(std::lround(place.x())), 0, image.cols - 1),
          std::clamp(static_cast<int>(std::lround(place.y())), 0, image.rows - 1)};
}

/// Depth at a pixel [m]; 0 where there is none.
float DepthAt(const cv::Mat& depth_m, const Eigen::Vector2f& pixel) {
  const float depth = depth_m.at<float>(NearestPixel(depth_m, pixel));
  return std::isfinite(depth) && depth > 0 ? depth : 0;
}

}  // namespace

OctaveScales::OctaveScales(int levels, double scale_factor) {
  OFM_CHECK(levels > 0 && scale_factor > 1);
  double scale = 1;
  for (int i = 0; i < levels; ++i, scale *= scale_factor) {
    scales_.push_back(static_cast<float>(scale));
  }
}

int OctaveScales::PredictOctave(float max_distance_m, float distance_m) const {
  const float ratio = max_distance_m / std::max(distance_m, 1e-6F);
  int octave = 0;
  while (octave + 1 < levels() && scales_[octave] < ratio) ++octave;
  return octave;
}

std::shared_ptr<const FrameFeatures> MakeFrameFeatures(Features features, const cv::Mat& depth_m,
                                                       const PinholeCamera& camera,
                                                       const cv::Mat& static_probability) {
  OFM_CHECK(features.keypoints.size() == features.descriptors.size());
  OFM_CHECK(features.patches.empty() || features.patches.size() == features.size());
  auto frame = std::make_shared<FrameFeatures>();
  frame->keypoints = std::move(features.keypoints);
  frame->descriptors = std::move(features.descriptors);
  if (!features.patches.empty()) {
    frame->patches = std::make_shared<const std::vector<ImagePatch>>(std::move(features.patches));
  }
  frame->ideal_px.reserve(frame->size());
  frame->depth_m.reserve(frame->size());
  for (const Keypoint& keypoint : frame->keypoints) {
    frame->ideal_px.push_back(camera.Undistort(keypoint.pixel.cast<double>()).cast<float>());
    frame->depth_m.push_back(DepthAt(depth_m, keypoint.pixel));
    if (static_probability.empty()) continue;
    const cv::Point pixel = NearestPixel(static_probability, keypoint.pixel);
    frame->static_probability.push_back(static_probability.at<std::uint8_t>(pixel) / 255.0F);
  }
  frame->grid = FeatureGrid(frame->ideal_px, camera.width, camera.height);
  return frame;
}

std::shared_ptr<const FrameFeatures> AlignDepthInTime(
    const FrameFeatures& frame, const cv::Mat& depth_m,
    const RigidTransform& depth_camera_from_color_camera, const PinholeCamera& camera) {
  constexpr int kIterations = 2;
  auto aligned = std::make_shared<FrameFeatures>(frame);
  const RigidTransform color_from_depth = depth_camera_from_color_camera.Inverse();
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Eigen::Vector2d ideal_px = frame.ideal_px[i].cast<double>();
    double depth = frame.depth_m[i];
    for (int k = 0; k < kIterations && depth > 0; ++k) {
      const Eigen::Vector3d in_depth_camera =
          depth_camera_from_color_camera * camera.UnprojectIdeal(ideal_px, depth);
      if (in_depth_camera.z() <= 0) break;
      const Eigen::Vector2d pixel = camera.Project(in_depth_camera);
      if (!camera.IsInImage(pixel)) break;
      const float measured = DepthAt(depth_m, pixel.cast<float>());
      if (measured <= 0) break;
      const Eigen::Vector3d seen = in_depth_camera / in_depth_camera.z() * measured;
      depth = (color_from_depth * seen).z();
    }
    if (depth > 0) aligned->depth_m[i] = static_cast<float>(depth);
  }
  return aligned;
}

std::optional<Eigen::Vector3d> PointInCamera(const FrameFeatures& features, int index,
                                             const PinholeCamera& camera) {
  const float depth = features.depth_m[index];
  if (depth <= 0) return {};
  return camera.UnprojectIdeal(features.ideal_px[index].cast<double>(), depth);
}

}  // namespace ofm
