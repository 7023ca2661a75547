#include "ofm/dense/keyframe_cloud.h"

#include <cmath>

#include "ofm/base/check.h"
#include "ofm/camera/depth_noise.h"
#include "ofm/dense/usable_pixels.h"
#include "ofm/dense/voxel_filter.h"

namespace ofm {
namespace {

void CheckImage(const cv::Mat& image, int type, const PinholeCamera& camera) {
  OFM_CHECK(image.type() == type);
  OFM_CHECK(image.cols == camera.width && image.rows == camera.height);
}

void CheckFrame(const LabelledFrame& frame, const PinholeCamera& camera) {
  CheckImage(frame.color, CV_8UC3, camera);
  CheckImage(frame.depth_m, CV_32FC1, camera);
  OFM_CHECK(frame.class_ids.empty() == frame.confidence.empty());
  for (const cv::Mat* image : {&frame.class_ids, &frame.confidence, &frame.dynamic_mask}) {
    if (!image->empty()) CheckImage(*image, CV_8UC1, camera);
  }
  if (!frame.instances.empty()) CheckImage(frame.instances, CV_16UC1, camera);
}

template <class T>
const T* RowOf(const cv::Mat& image, int row) {
  return image.empty() ? nullptr : image.ptr<T>(row);
}

/// Colours and labels of one image row.
struct RowReader {
  const cv::Vec3b* color;
  const std::uint8_t* class_ids;   // null without labels
  const std::uint8_t* confidence;  // null without labels
  const std::uint16_t* instances;  // null without instances
  std::uint8_t unlabelled_confidence;

  LabelledPoint At(int column, const Eigen::Vector3f& position) const {
    const cv::Vec3b& bgr = color[column];
    LabelledPoint point{position, {bgr[2], bgr[1], bgr[0]}, kNoLabel, unlabelled_confidence};
    const double sigma_m = DepthSigma(position.z());
    point.precision = static_cast<float>(1 / (sigma_m * sigma_m));
    if (class_ids != nullptr && class_ids[column] != kNoLabel) {
      point.class_id = class_ids[column];
      point.confidence = confidence[column];
      if (instances != nullptr) point.instance = instances[column];
    }
    return point;
  }
};

}  // namespace

WorldScan TransformToWorld(const KeyframeCloud& cloud, const RigidTransform& world_from_camera) {
  const Eigen::Matrix3f rotation = world_from_camera.RotationMatrix().cast<float>();
  const Eigen::Vector3f origin = world_from_camera.translation().cast<float>();
  WorldScan scan{origin, cloud.points_in_camera, cloud.free_ends_in_camera};
  for (LabelledPoint& point : scan.points) point.position = rotation * point.position + origin;
  for (Eigen::Vector3f& end : scan.free_ends) end = rotation * end + origin;
  return scan;
}

KeyframeCloudMaker::KeyframeCloudMaker(const PinholeCamera& camera, const DenseOptions& options)
    : camera_(camera), options_(options) {
  CheckOptions(options);
  const UndistortionTable table(camera);
  rays_.reserve(static_cast<std::size_t>(camera.width) * camera.height);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      rays_.push_back(
          camera.UnprojectIdeal(table.At(column, row).cast<double>(), 1).head<2>().cast<float>());
    }
  }
}

KeyframeCloud KeyframeCloudMaker::Make(const LabelledFrame& frame) const {
  CheckFrame(frame, camera_);
  const cv::Mat usable = FindUsablePixels(frame, options_.cloud);
  const auto range = static_cast<float>(options_.range_m);
  const auto unlabelled =
      static_cast<std::uint8_t>(std::lround(255 * options_.cloud.unlabelled_confidence));
  VoxelFilter near(options_.CloudResolution()), far(options_.resolution_m);
  for (int row = 0; row < camera_.height; ++row) {
    const auto* row_usable = usable.ptr<std::uint8_t>(row);
    const auto* row_depth = frame.depth_m.ptr<float>(row);
    const Eigen::Vector2f* row_rays = &rays_[static_cast<std::size_t>(row) * camera_.width];
    const RowReader reader{frame.color.ptr<cv::Vec3b>(row),
                           RowOf<std::uint8_t>(frame.class_ids, row),
                           RowOf<std::uint8_t>(frame.confidence, row),
                           RowOf<std::uint16_t>(frame.instances, row), unlabelled};
    for (int column = 0; column < camera_.width; ++column) {
      if (row_usable[column] == 0) continue;
      const Eigen::Vector3f point =
          Eigen::Vector3f(row_rays[column].x(), row_rays[column].y(), 1) * row_depth[column];
      const float distance = point.norm();
      if (distance <= range) {
        near.Add(reader.At(column, point));
      } else {
        far.Add({point * (range / distance), {}, kNoLabel, 0});
      }
    }
  }
  KeyframeCloud cloud{near.Points(), {}};
  for (const LabelledPoint& end : far.Points()) cloud.free_ends_in_camera.push_back(end.position);
  return cloud;
}

}  // namespace ofm
