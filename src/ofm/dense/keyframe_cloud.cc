#include "ofm/dense/keyframe_cloud.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/camera/depth_noise.h"
#include "ofm/dense/usable_pixels.h"
#include "ofm/dense/voxel_filter.h"
#include "ofm/dense/voxel_table.h"

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

/// Of the i-th frame of a cloud; the last bit serves all that are left.
FrameBits BitOf(std::size_t i) {
  constexpr std::size_t kBits = 32;
  return FrameBits{1} << std::min(i, kBits - 1);
}

/// For images of every `step`-th pixel.
KeyframeCloudOptions Coarsened(KeyframeCloudOptions options, int step) {
  options.mask_dilation_px = (options.mask_dilation_px + step - 1) / step;
  options.mask_margin_px = (options.mask_margin_px + step - 1) / step;
  return options;
}

/// Of the frame's image, without its border if there are masks to end there too early.
cv::Rect InnerPart(const LabelledFrame& frame, double border_share) {
  const cv::Size size = frame.depth_m.size();
  if (frame.dynamic_mask.empty()) return {{}, size};
  const int border = static_cast<int>(std::lround(border_share * size.width));
  return {border, border, size.width - 2 * border, size.height - 2 * border};
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

SeenSpan KeyframeCloud::SpanOf(FrameBits frames) const {
  SeenSpan span;
  for (; frames != 0; frames &= frames - 1) {
    const std::int64_t stamp_ns = stamps_ns.at(std::countr_zero(frames));
    span = span.Joined({stamp_ns, stamp_ns});
  }
  return span;
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

  VoxelFilter near, far;                 // within the range, and the ends of rays that go beyond
  std::vector<FrameBits> seen_in;        // by voxel of `near`
  std::vector<std::uint8_t> off_border;  // likewise
  VoxelTable mover_voxels;
  std::vector<FrameBits> movers_seen_in;  // by voxel
};

void KeyframeCloudMaker::Gather(const LabelledFrame& frame, FrameBits bit,
                                Gathered& gathered) const {
  const int step = FindPixelStep(frame, camera_);
  const cv::Mat usable = FindUsablePixels(frame, Coarsened(options_.cloud, step));
  const cv::Rect inner = InnerPart(frame, options_.passing.border_share);
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
        const auto voxel = gathered.near.Add(reader.At(column, rotation * point + origin, depth_m));
        if (!voxel) continue;
        if (*voxel == gathered.seen_in.size()) {
          gathered.seen_in.push_back(0);
          gathered.off_border.push_back(0);
        }
        gathered.seen_in[*voxel] |= bit;
        if (inner.contains({column, row})) gathered.off_border[*voxel] = 1;
      } else {
        gathered.far.Add({rotation * (point * (range / distance)) + origin, {}, kNoLabel, 0});
      }
    }
  }
}

/// What moves, but for the masks' rims: masks are often a few pixels too large.
void KeyframeCloudMaker::GatherMovers(const LabelledFrame& frame, FrameBits bit,
                                      Gathered& gathered) const {
  if (frame.dynamic_mask.empty()) return;
  constexpr int kRim_px = 4, kStride_px = 4;  // of the camera's pixels
  const int step = FindPixelStep(frame, camera_), rim = kRim_px / step;
  cv::Mat moving;
  cv::erode(frame.dynamic_mask, moving,
            cv::getStructuringElement(cv::MORPH_RECT, {2 * rim + 1, 2 * rim + 1}));
  const Eigen::Matrix3f rotation = frame.keyframe_from_depth.RotationMatrix().cast<float>();
  const Eigen::Vector3f origin = frame.keyframe_from_depth.translation().cast<float>();
  const int stride = std::max(1, kStride_px / step);
  for (int row = 0; row < moving.rows; row += stride) {
    for (int column = 0; column < moving.cols; column += stride) {
      const float depth_m = frame.depth_m.at<float>(row, column);
      if (moving.at<std::uint8_t>(row, column) == 0 || !(depth_m > 0)) continue;
      const Eigen::Vector2f& ray =
          rays_[(static_cast<std::size_t>(row) * camera_.width + column) * step];
      const Eigen::Vector3f point = Eigen::Vector3f(ray.x(), ray.y(), 1) * depth_m;
      if (!(point.norm() <= options_.range_m)) continue;
      const auto voxel = FindVoxel(rotation * point + origin, 1 / KeyframeCloud::kMoverVoxel_m);
      if (!voxel) continue;
      const std::uint32_t number = gathered.mover_voxels.Insert(*voxel);
      if (number == gathered.movers_seen_in.size()) gathered.movers_seen_in.push_back(0);
      gathered.movers_seen_in[number] |= bit;
    }
  }
}

KeyframeCloud KeyframeCloudMaker::Make(const LabelledFrame& keyframe,
                                       std::span<const LabelledFrame> views) const {
  Gathered gathered(options_);
  std::vector<LabelledFrame> frames{keyframe};
  frames.insert(frames.end(), views.begin(), views.end());
  KeyframeCloud cloud;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Gather(frames[i], BitOf(i), gathered);
    GatherMovers(frames[i], BitOf(i), gathered);
    cloud.stamps_ns.resize(std::bit_width(BitOf(i)), frames[i].stamp_ns);
  }
  cloud.points_in_camera = gathered.near.Points();
  cloud.seen_in = std::move(gathered.seen_in);
  cloud.off_border = std::move(gathered.off_border);
  for (std::uint32_t number = 0; number < gathered.mover_voxels.size(); ++number) {
    cloud.movers_in_camera.push_back(
        {VoxelCenter(gathered.mover_voxels.At(number), KeyframeCloud::kMoverVoxel_m),
         gathered.movers_seen_in[number]});
  }
  for (const LabelledPoint& end : gathered.far.Points()) {
    cloud.free_ends_in_camera.push_back(end.position);
  }
  return cloud;
}

}  // namespace ofm
