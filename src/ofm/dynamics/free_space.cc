#include "ofm/dynamics/free_space.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "ofm/base/time.h"

namespace ofm {
namespace {

/// How many of the earlier views say what of a cell.
struct Votes {
  int free = 0, same = 0;
};

/// The lattice's camera, in single precision.
struct Intrinsics {
  explicit Intrinsics(const PinholeCamera& camera)
      : fx(static_cast<float>(camera.fx)),
        fy(static_cast<float>(camera.fy)),
        cx(static_cast<float>(camera.cx)),
        cy(static_cast<float>(camera.cy)) {}

  float fx, fy, cx, cy;
};

/// Carries the cells of one view into another and compares depths.
class ViewComparison {
 public:
  ViewComparison(const Intrinsics& lattice, const DepthView& current, const DepthView& earlier,
                 const FreeSpaceOptions& options)
      : lattice_(lattice),
        earlier_(earlier),
        margin_m_(static_cast<float>(options.margin_m)),
        margin_per_metre_(static_cast<float>(options.margin_per_metre)) {
    const RigidTransform motion = earlier.camera_from_start * current.camera_from_start.Inverse();
    rotation_ = motion.RotationMatrix().cast<float>();
    translation_ = motion.translation().cast<float>();
  }

  void Vote(const Eigen::Vector3f& point_in_current, Votes& votes) const {
    const Eigen::Vector3f point = rotation_ * point_in_current + translation_;
    if (point.z() <= 0) return;
    const float u = lattice_.fx * point.x() / point.z() + lattice_.cx;
    const float v = lattice_.fy * point.y() / point.z() + lattice_.cy;
    const cv::Size size = earlier_.depth_m.size();
    if (!(u > -0.5F && v > -0.5F && u < size.width - 0.5F && v < size.height - 0.5F)) return;
    const int column = static_cast<int>(u + 0.5F), row = static_cast<int>(v + 0.5F);
    const float margin = margin_m_ + margin_per_metre_ * point.z();
    const float seen = earlier_.depth_m.ptr<float>(row)[column];
    votes.free += earlier_.least_depth_m.ptr<float>(row)[column] > point.z() + margin;
    votes.same += seen > 0 && std::abs(seen - point.z()) < margin;
  }

 private:
  Intrinsics lattice_;
  const DepthView& earlier_;
  float margin_m_, margin_per_metre_;
  Eigen::Matrix3f rotation_;
  Eigen::Vector3f translation_;
};

}  // namespace

DepthView MakeDepthView(std::int64_t stamp_ns, const RigidTransform& camera_from_start,
                        const cv::Mat& depth_m) {
  DepthView view{stamp_ns, camera_from_start, depth_m, {}};
  // The erosion of a cell beside one without depth is 0.
  cv::erode(depth_m, view.least_depth_m, cv::Mat::ones(3, 3, CV_8UC1));
  return view;
}

void DepthMemory::Add(const DepthView& view, const FreeSpaceOptions& options) {
  const auto age_s = [&](const DepthView& kept) {
    return NanosecondsToSeconds(view.stamp_ns - kept.stamp_ns);
  };
  while (!views_.empty() && age_s(views_.front()) > options.memory_s) views_.pop_front();
  constexpr double kOfInterval = 0.9;  // frames do not come at exact multiples of the interval
  if (options.memory_s <= 0) return;
  if (views_.empty() || age_s(views_.back()) > kOfInterval * options.interval_s) {
    views_.push_back(view);
  }
}

std::vector<const DepthView*> DepthMemory::Select(std::int64_t stamp_ns,
                                                  const FreeSpaceOptions& options) const {
  std::vector<const DepthView*> selected;
  for (double age_s = options.interval_s; age_s <= options.memory_s; age_s *= 2) {
    const std::int64_t wanted_ns = stamp_ns - SecondsToNanoseconds(age_s);
    const DepthView* nearest = nullptr;
    for (const DepthView& view : views_) {
      const auto distance = [&](const DepthView& v) { return std::abs(v.stamp_ns - wanted_ns); };
      if (nearest == nullptr || distance(view) < distance(*nearest)) nearest = &view;
    }
    const bool is_new = nearest != nullptr && (selected.empty() || selected.back() != nearest);
    if (is_new) selected.push_back(nearest);
  }
  return selected;
}

cv::Mat FreeSpaceEvidence(const PinholeCamera& lattice_camera, const DepthView& current,
                          const std::vector<const DepthView*>& earlier,
                          const FreeSpaceOptions& options) {
  const Intrinsics lattice(lattice_camera);
  std::vector<ViewComparison> comparisons;
  for (const DepthView* view : earlier) {
    comparisons.emplace_back(lattice, current, *view, options);
  }
  cv::Mat evidence(current.depth_m.size(), CV_32FC1, cv::Scalar(0));
  for (int y = 0; y < evidence.rows; ++y) {
    for (int x = 0; x < evidence.cols; ++x) {
      const float depth = current.depth_m.at<float>(y, x);
      if (depth <= 0) continue;
      const Eigen::Vector3f point((x - lattice.cx) / lattice.fx * depth,
                                  (y - lattice.cy) / lattice.fy * depth, depth);
      Votes votes;
      for (const ViewComparison& comparison : comparisons) comparison.Vote(point, votes);
      evidence.at<float>(y, x) = static_cast<float>(
          votes.free > 0 ? options.log_odds : votes.same * options.static_log_odds);
    }
  }
  return evidence;
}

}  // namespace ofm
