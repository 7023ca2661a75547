#include "ofm/perception/mask_propagation.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/time.h"
#include "ofm/perception/coarse_shift.h"
#include "ofm/perception/depth_range.h"
#include "ofm/perception/mask_growth.h"
#include "ofm/perception/mask_parts.h"

namespace ofm {
namespace {

/// Masks are worked on at half the resolution.
constexpr int kScale = 2;
constexpr std::size_t kMinDepths = 4;
/// Of an object's pixels that must be found at its depth, where flow finds nothing.
constexpr double kMinAgreement = 0.5;

cv::Size Reduced(cv::Size size) { return {size.width / kScale, size.height / kScale}; }

/// How an instance moved, and the depths that it has now.
struct Carriage {
  std::optional<DisplacementField> field;  ///< empty = flow was lost
  std::optional<DepthRange> depths;        ///< empty = not measured
  Eigen::Vector2f shift_px = {0, 0};       ///< for all pixels, where there is no field
  bool is_found = true;                    ///< false: where it would be had it gone on
};

float DepthAt(const cv::Mat& depth_m, const Eigen::Vector2f& point) {
  const int x = std::clamp(static_cast<int>(std::lround(point.x())), 0, depth_m.cols - 1);
  const int y = std::clamp(static_cast<int>(std::lround(point.y())), 0, depth_m.rows - 1);
  return depth_m.at<float>(y, x);
}

/// Carries one instance between two frames.
class Carrier {
 public:
  Carrier(const FlowFrame& from, const FlowFrame& to, const MaskPropagationOptions& options,
          const OpticalFlowOptions& flow_options)
      : from_(from), to_(to), options_(options), flow_options_(flow_options) {
    interval_s_ = NanosecondsToSeconds(to.stamp_ns - from.stamp_ns);
  }

  /// Empty where the instance is gone.
  std::optional<CarriedInstance> Carry(const CarriedInstance& before) const {
    const Carriage carriage = Follow(before);
    CarriedInstance now = before;
    if (carriage.is_found) {
      now.lost_s = 0;
      const Eigen::Vector2f shift =
          carriage.field ? carriage.field->mean_shift() : carriage.shift_px;
      if (interval_s_ > 0) now.velocity_px_s = shift / static_cast<float>(interval_s_);
    } else {
      now.lost_s += interval_s_;
      if (now.lost_s > options_.max_lost_s) return {};
    }
    // A new image: assigning a cv::MatExpr would write into the one that is shared with `before`.
    now.instance.mask = cv::Mat(from_.pyramid.size, CV_8UC1, cv::Scalar(0));
    now.instance.box = {};
    Warp(before.instance, carriage, now.instance);
    if (now.instance.box.empty()) return {};
    return now;
  }

 private:
  /// The motion of the instance's points.
  Carriage Follow(const CarriedInstance& before) const {
    Carriage carriage;
    const Instance& instance = before.instance;
    const Eigen::Vector2f expected = before.velocity_px_s * static_cast<float>(interval_s_);
    const CoarseShift coarse =
        FindCoarseShift(instance, from_, to_, {expected, options_.search_px});
    const auto points = FindMaskPoints(from_.pyramid, instance.mask, instance.box, options_.points);
    const PointMotion motion = FollowPoints(points, coarse.shift_px);
    carriage.field = DisplacementField::Fit(motion, options_.displacement);
    std::vector<float> depths;
    if (carriage.field) {
      for (const std::size_t i : carriage.field->inliers()) {
        depths.push_back(DepthAt(to_.depth_m, motion.to[i]));
      }
    } else {
      carriage.shift_px = coarse.agreement > kMinAgreement ? coarse.shift_px : expected;
      carriage.is_found = coarse.agreement > kMinAgreement;
      depths = SampleDepths(instance.mask(instance.box), from_.depth_m(instance.box), 4);
    }
    carriage.depths = FindDepthRange(std::move(depths), options_.depth_margin_m, kMinDepths);
    return carriage;
  }

  PointMotion FollowPoints(const std::vector<Eigen::Vector2f>& points,
                           const Eigen::Vector2f& shift_px) const {
    std::vector<Eigen::Vector2f> expected = points;
    for (Eigen::Vector2f& point : expected) point += shift_px;
    const FlowResult flow =
        TrackPoints(from_.pyramid, to_.pyramid, points, expected, flow_options_);
    PointMotion motion;
    const auto limit = static_cast<float>(options_.max_departure_px);
    for (std::size_t i = 0; i < flow.size(); ++i) {
      if (!flow.IsTracked(i) || (flow.current[i] - expected[i]).norm() > limit) continue;
      if (!KeepsDepth(flow.previous[i], flow.current[i])) continue;
      motion.from.push_back(flow.previous[i]);
      motion.to.push_back(flow.current[i]);
    }
    return motion;
  }

  /// False where the depths at the two ends are known to be those of different objects.
  bool KeepsDepth(const Eigen::Vector2f& from, const Eigen::Vector2f& to) const {
    const float from_m = DepthAt(from_.depth_m, from), to_m = DepthAt(to_.depth_m, to);
    if (from_m == 0 || to_m == 0) return true;
    return std::abs(from_m - to_m) <= options_.depth_margin_m;
  }

  /// Where the instance may be now, in pixels of the reduced image.
  cv::Rect Region(const Instance& instance, const Carriage& carriage) const {
    const cv::Rect& box = instance.box;
    const auto forward = [&](float x, float y) {
      const Eigen::Vector2f point(x, y);
      return carriage.field ? carriage.field->Forward(point)
                            : Eigen::Vector2f(point + carriage.shift_px);
    };
    const auto left = static_cast<float>(box.x), top = static_cast<float>(box.y);
    const auto right = static_cast<float>(box.br().x), bottom = static_cast<float>(box.br().y);
    Eigen::Vector2f low = forward(left, top), high = low;
    for (const auto& corner :
         {forward(right, top), forward(left, bottom), forward(right, bottom)}) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    // What touches the border goes on beyond it: as much of the image as the object moved away.
    const cv::Size size = from_.pyramid.size;
    if (box.x <= 1) low.x() = std::min(low.x(), 0.0F);
    if (box.y <= 1) low.y() = std::min(low.y(), 0.0F);
    if (box.br().x >= size.width - 1) high.x() = std::max(high.x(), float(size.width));
    if (box.br().y >= size.height - 1) high.y() = std::max(high.y(), float(size.height));
    const auto margin =
        static_cast<float>(options_.displacement.max_tolerance_px + options_.growth_px);
    const auto reduce = [&](float value, int limit) {
      return std::clamp(static_cast<int>(std::lround(value / kScale)), 0, limit);
    };
    const cv::Size reduced = Reduced(size);
    const cv::Point corner(reduce(low.x() - margin, reduced.width),
                           reduce(low.y() - margin, reduced.height));
    const cv::Point end(reduce(high.x() + margin, reduced.width),
                        reduce(high.y() + margin, reduced.height));
    return {corner, end};
  }

  /// Where the pixels of `region` came from, in pixels of the reduced image.
  cv::Mat Sources(const cv::Rect& region, const Carriage& carriage) const {
    cv::Mat source;
    if (carriage.field) {
      source = carriage.field->SourceOf(region, kScale);
      return (source - cv::Scalar::all(0.5 * (kScale - 1))) / kScale;
    }
    source.create(region.size(), CV_32FC2);
    for (int y = 0; y < region.height; ++y) {
      for (int x = 0; x < region.width; ++x) {
        source.at<cv::Vec2f>(y, x) = {
            static_cast<float>(region.x + x) - carriage.shift_px.x() / kScale,
            static_cast<float>(region.y + y) - carriage.shift_px.y() / kScale};
      }
    }
    return source;
  }

  /// Writes mask and box.
  void Warp(const Instance& before, const Carriage& carriage, Instance& now) const {
    const cv::Rect region = Region(before, carriage);
    if (region.empty()) return;
    const cv::Size reduced = Reduced(from_.pyramid.size);
    cv::Mat half, mask, depth_m;
    cv::resize(before.mask, half, reduced, 0, 0, cv::INTER_LINEAR);
    const cv::Mat sources = Sources(region, carriage);
    cv::remap(half, mask, sources, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    cv::threshold(mask, mask, 127, 255, cv::THRESH_BINARY);
    if (carriage.depths) {
      const int warped = cv::countNonZero(mask);
      cv::resize(to_.depth_m, depth_m, reduced, 0, 0, cv::INTER_NEAREST);
      depth_m = depth_m(region);
      TrimToDepth(depth_m, *carriage.depths, mask);
      MaskGrowth growth;
      growth.distance_px = options_.growth_px / kScale;
      growth.max_added = static_cast<int>(options_.growth_budget * warped) - cv::countNonZero(mask);
      growth.step_m = static_cast<float>(options_.growth_step_m);
      growth.range = *carriage.depths;
      growth.free = ComeIntoView(sources, reduced);
      GrowAlongDepth(depth_m, growth, mask);
    }
    constexpr int kMinArea = 64 / (kScale * kScale);
    if (KeepLargestParts(options_.min_part_share, mask) < kMinArea) return;
    CloseHoles(options_.max_hole_px / (kScale * kScale), mask);
    Enlarge(mask, region, now);
  }

  /// 255 where a pixel came from outside the image (of size `image`).
  static cv::Mat ComeIntoView(const cv::Mat& sources, cv::Size image) {
    cv::Mat outside(sources.size(), CV_8UC1);
    const auto right = static_cast<float>(image.width - 1);
    const auto bottom = static_cast<float>(image.height - 1);
    for (int y = 0; y < sources.rows; ++y) {
      const auto* source = sources.ptr<cv::Vec2f>(y);
      std::uint8_t* to = outside.ptr(y);
      for (int x = 0; x < sources.cols; ++x) {
        const bool inside = source[x][0] >= 0 && source[x][1] >= 0 && source[x][0] <= right &&
                            source[x][1] <= bottom;
        to[x] = inside ? 0 : 255;
      }
    }
    return outside;
  }

  /// From the reduced image to the whole one.
  void Enlarge(const cv::Mat& mask, const cv::Rect& region, Instance& now) const {
    cv::Mat half = cv::Mat::zeros(Reduced(from_.pyramid.size), CV_8UC1);
    mask.copyTo(half(region));
    cv::resize(half, now.mask, now.mask.size(), 0, 0, cv::INTER_LINEAR);
    cv::threshold(now.mask, now.mask, 127, 255, cv::THRESH_BINARY);
    now.box = cv::boundingRect(now.mask);
  }

  const FlowFrame& from_;
  const FlowFrame& to_;
  const MaskPropagationOptions& options_;
  const OpticalFlowOptions& flow_options_;
  double interval_s_ = 0;
};

}  // namespace

std::vector<CarriedInstance> CarryInstances(std::span<const CarriedInstance> instances,
                                            const FlowFrame& from, const FlowFrame& to,
                                            const MaskPropagationOptions& options,
                                            const OpticalFlowOptions& flow_options) {
  OFM_CHECK(from.pyramid.size == to.pyramid.size && from.depth_m.size() == from.pyramid.size &&
            to.depth_m.size() == to.pyramid.size);
  const Carrier carrier(from, to, options, flow_options);
  std::vector<CarriedInstance> carried;
  for (const CarriedInstance& instance : instances) {
    OFM_CHECK(instance.instance.mask.size() == from.pyramid.size);
    if (auto now = carrier.Carry(instance)) carried.push_back(std::move(*now));
  }
  return carried;
}

}  // namespace ofm
