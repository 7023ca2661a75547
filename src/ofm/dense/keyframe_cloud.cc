#include "ofm/dense/keyframe_cloud.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/camera/depth_noise.h"
#include "ofm/dense/loose_pieces.h"
#include "ofm/dense/usable_pixels.h"
#include "ofm/dense/voxel_filter.h"

namespace ofm {
namespace {

void CheckImage(const cv::Mat& image, int type, cv::Size size) {
  OFM_CHECK(image.type() == type);
  OFM_CHECK(image.size() == size);
}

void CheckImages(const LabelledFrame& frame, cv::Size size) {
  CheckImage(frame.color, CV_8UC3, size);
  CheckImage(frame.depth_m, CV_32FC1, size);
  OFM_CHECK(frame.class_ids.empty() == frame.confidence.empty());
  for (const cv::Mat* image : {&frame.class_ids, &frame.confidence, &frame.dynamic_mask}) {
    if (!image->empty()) CheckImage(*image, CV_8UC1, size);
  }
  if (!frame.instances.empty()) CheckImage(frame.instances, CV_16UC1, size);
}

/// Pixels of the camera from one of the frame's to the next.
int FindPixelStep(const LabelledFrame& frame, const PinholeCamera& camera) {
  OFM_CHECK(!frame.depth_m.empty());
  const int step = camera.width / frame.depth_m.cols;
  OFM_CHECK(step > 0);
  CheckImages(frame, {camera.width / step, camera.height / step});
  return step;
}

/// For images of every `step`-th pixel.
KeyframeCloudOptions Coarsened(KeyframeCloudOptions options, int step) {
  options.mask_dilation_px = (options.mask_dilation_px + step - 1) / step;
  options.mask_margin_px = (options.mask_margin_px + step - 1) / step;
  return options;
}

cv::Mat Resized(const cv::Mat& image, cv::Size size) {
  if (image.size() == size) return image;
  cv::Mat resized;
  cv::resize(image, resized, size, 0, 0, cv::INTER_NEAREST);
  return resized;
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

  LabelledPoint At(int column, const Eigen::Vector3f& position, double depth_m) const {
    const cv::Vec3b& bgr = color[column];
    LabelledPoint point{position, {bgr[2], bgr[1], bgr[0]}, kNoLabel, unlabelled_confidence};
    const double sigma_m = DepthSigma(depth_m);
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

/// Points in the key frame's camera.
struct KeyframeCloudMaker::Gathered {
  explicit Gathered(const DenseOptions& options)
      : near(options.CloudResolution()), far(options.resolution_m) {}

  VoxelFilter near, far;  // within the range, and the ends of rays that go beyond
};

/// For each frame CV_8UC1 of its size, 255 where a pixel is mapped.
std::vector<cv::Mat> KeyframeCloudMaker::FindUsable(std::span<const LabelledFrame> frames) const {
  std::vector<cv::Mat> usable;
  std::vector<PieceView> pieces;
  const cv::Size size = frames.back().depth_m.size();  // of the views, if there are any
  for (const LabelledFrame& frame : frames) {
    const KeyframeCloudOptions options = Coarsened(options_.cloud, FindPixelStep(frame, camera_));
    const cv::Mat dynamic = FindDynamicPixels(frame.dynamic_mask, frame.depth_m, options);
    usable.push_back(FindSmoothPixels(frame.depth_m, options));
    usable.back().setTo(0, dynamic);
    pieces.push_back(
        {Resized(frame.depth_m, size), Resized(dynamic, size), frame.keyframe_from_depth});
  }
  const std::vector<cv::Mat> loose = FindLoosePieces(pieces, camera_, rays_, options_.cloud);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    usable[i].setTo(0, Resized(loose[i], usable[i].size()));
  }
  return usable;
}

void KeyframeCloudMaker::Gather(const LabelledFrame& frame, const cv::Mat& usable,
                                Gathered& gathered) const {
  const int step = FindPixelStep(frame, camera_);
  const auto range = static_cast<float>(options_.range_m);
  const auto unlabelled =
      static_cast<std::uint8_t>(std::lround(255 * options_.cloud.unlabelled_confidence));
  const Eigen::Matrix3f rotation = frame.keyframe_from_depth.RotationMatrix().cast<float>();
  const Eigen::Vector3f origin = frame.keyframe_from_depth.translation().cast<float>();
  for (int row = 0; row < usable.rows; ++row) {
    const auto* row_usable = usable.ptr<std::uint8_t>(row);
    const auto* row_depth = frame.depth_m.ptr<float>(row);
    const Eigen::Vector2f* row_rays = &rays_[static_cast<std::size_t>(row) * step * camera_.width];
    const RowReader reader{frame.color.ptr<cv::Vec3b>(row),
                           RowOf<std::uint8_t>(frame.class_ids, row),
                           RowOf<std::uint8_t>(frame.confidence, row),
                           RowOf<std::uint16_t>(frame.instances, row), unlabelled};
    for (int column = 0; column < usable.cols; ++column) {
      if (row_usable[column] == 0) continue;
      const float depth_m = row_depth[column];
      const Eigen::Vector2f& ray = row_rays[static_cast<std::ptrdiff_t>(column) * step];
      const Eigen::Vector3f point = Eigen::Vector3f(ray.x(), ray.y(), 1) * depth_m;
      const float distance = point.norm();
      if (distance <= range) {
        gathered.near.Add(reader.At(column, rotation * point + origin, depth_m));
      } else {
        gathered.far.Add({rotation * (point * (range / distance)) + origin, {}, kNoLabel, 0});
      }
    }
  }
}

KeyframeCloud KeyframeCloudMaker::Make(const LabelledFrame& keyframe,
                                       std::span<const LabelledFrame> views) const {
  Gathered gathered(options_);
  std::vector<LabelledFrame> frames{keyframe};
  frames.insert(frames.end(), views.begin(), views.end());
  const std::vector<cv::Mat> usable = FindUsable(frames);
  for (std::size_t i = 0; i < frames.size(); ++i) Gather(frames[i], usable[i], gathered);
  KeyframeCloud cloud{gathered.near.Points(), {}};
  for (const LabelledPoint& end : gathered.far.Points()) {
    cloud.free_ends_in_camera.push_back(end.position);
  }
  return cloud;
}

}  // namespace ofm
