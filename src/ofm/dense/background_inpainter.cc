#include "ofm/dense/background_inpainter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/camera/depth_noise.h"
#include "ofm/dense/usable_pixels.h"

namespace ofm {
namespace {

/// What a source shows at a hidden pixel.
struct Candidate {
  float depth_m = 0;
  cv::Vec3b color;
};

/// Mean brightness of a source and of the target where both show the same surface.
class Exposure {
 public:
  void Add(const cv::Vec3b& source, const cv::Vec3b& target) {
    for (int channel = 0; channel < 3; ++channel) {
      source_ += source[channel];
      target_ += target[channel];
    }
    ++pixels_;
  }
  /// By which the source's colours are multiplied; 1 where too little is known.
  double Gain() const {
    constexpr int kMinPixels = 500;
    if (pixels_ < kMinPixels || source_ == 0) return 1;
    return std::clamp(target_ / source_, .5, 2.);
  }

 private:
  double source_ = 0, target_ = 0;
  int pixels_ = 0;
};

/// One source as it looks from the target, at the target's hidden pixels.
struct WarpedView {
  cv::Mat depth_m;  // CV_32FC1, 0 = nothing
  cv::Mat color;    // CV_8UC3
  Exposure exposure;
};

class Warper {
 public:
  /// `world_from_target` is where the target was when that of its images was taken that is filled.
  Warper(const PinholeCamera& camera, const SceneView& target,
         const RigidTransform& world_from_target, const cv::Mat& hidden)
      : camera_(camera),
        target_(target),
        target_from_world_(world_from_target.Inverse()),
        hidden_(hidden) {
    constexpr int kMargin_px = 48;  // more than the lens moves a point
    const cv::Rect box = cv::boundingRect(hidden);
    near_hidden_ = {box.x - kMargin_px, box.y - kMargin_px, box.width + 2 * kMargin_px,
                    box.height + 2 * kMargin_px};
  }

  WarpedView Warp(const StaticView& source) const {
    WarpedView warped{
        cv::Mat::zeros(hidden_.size(), CV_32FC1), cv::Mat::zeros(hidden_.size(), CV_8UC3), {}};
    const Eigen::Matrix3f rotation = target_from_world_.RotationMatrix().cast<float>();
    const Eigen::Vector3f translation = target_from_world_.translation().cast<float>();
    for (std::size_t i = 0; i < source.points_in_world.size(); ++i) {
      const Eigen::Vector3f point = rotation * source.points_in_world[i] + translation;
      constexpr float kMinDepth_m = .1F;
      if (point.z() < kMinDepth_m) continue;
      if (i % kExposureStep != 0 && !MayBeHidden(point)) continue;
      Draw(point.cast<double>(), source.colors[i], warped);
    }
    return warped;
  }

 private:
  static constexpr std::size_t kExposureStep = 8;  // of the points tell the brightness

  /// Quick, and true for every point that is drawn on a hidden pixel.
  bool MayBeHidden(const Eigen::Vector3f& point_in_target) const {
    const Eigen::Vector2d pixel = camera_.ProjectIdeal(point_in_target.cast<double>());
    return near_hidden_.contains({static_cast<int>(pixel.x()), static_cast<int>(pixel.y())});
  }

  /// On the four pixels around, so that surfaces stay closed where the target is nearer.
  void Draw(const Eigen::Vector3d& point_in_target, const cv::Vec3b& color,
            WarpedView& warped) const {
    const Eigen::Vector2d pixel = camera_.Project(point_in_target);
    if (!camera_.IsInImage(pixel)) return;
    const auto depth_m = static_cast<float>(point_in_target.z());
    const int left = static_cast<int>(pixel.x()), top = static_cast<int>(pixel.y());
    for (int i = 0; i < 4; ++i) {
      const int column = std::min(left + i % 2, hidden_.cols - 1);
      const int row = std::min(top + i / 2, hidden_.rows - 1);
      if (hidden_.at<std::uint8_t>(row, column) != 0) {
        float& nearest_m = warped.depth_m.at<float>(row, column);
        if (nearest_m != 0 && nearest_m <= depth_m) continue;
        nearest_m = depth_m;
        warped.color.at<cv::Vec3b>(row, column) = color;
      } else if (i == 0 && IsSameSurface(depth_m, target_.depth_m.at<float>(row, column))) {
        warped.exposure.Add(color, target_.color.at<cv::Vec3b>(row, column));
      }
    }
  }

  static bool IsSameSurface(double warped_m, double measured_m) {
    return measured_m > 0 && std::abs(warped_m - measured_m) < 3 * DepthSigma(measured_m);
  }

  const PinholeCamera& camera_;
  const SceneView& target_;
  RigidTransform target_from_world_;
  const cv::Mat& hidden_;
  cv::Rect near_hidden_;
};

cv::Vec3b Brightened(const cv::Vec3b& color, double gain) {
  cv::Vec3b result;
  for (int i = 0; i < 3; ++i) result[i] = cv::saturate_cast<std::uint8_t>(gain * color[i]);
  return result;
}

/// What the views (by time, nearest first) show at a pixel.
void GatherCandidates(const std::vector<WarpedView>& views, int row, int column,
                      std::vector<Candidate>& candidates) {
  candidates.clear();
  for (const WarpedView& view : views) {
    const float depth_m = view.depth_m.at<float>(row, column);
    if (depth_m == 0) continue;
    candidates.push_back(
        {depth_m, Brightened(view.color.at<cv::Vec3b>(row, column), view.exposure.Gain())});
  }
}

/// The nearest surface that enough of the candidates (by time, nearest first; not empty) show.
Candidate ChooseSurface(const std::vector<Candidate>& candidates,
                        const InpaintingOptions& options) {
  std::vector<float> depths_m;
  for (const Candidate& candidate : candidates) depths_m.push_back(candidate.depth_m);
  std::sort(depths_m.begin(), depths_m.end());
  const double enough =
      std::max(1., options.min_agreeing_share * static_cast<double>(candidates.size()));
  std::size_t first = 0, end = 0, most = 0;  // of the chosen cluster in depths_m
  for (std::size_t begin = 0, i = 1; i <= depths_m.size(); ++i) {
    const double gap_m = options.agreement_sigmas * DepthSigma(depths_m[i - 1]);
    if (i < depths_m.size() && depths_m[i] - depths_m[i - 1] <= gap_m) continue;
    if (i - begin > most) {
      most = i - begin;
      first = begin;
      end = i;
      if (static_cast<double>(most) >= enough) break;
    }
    begin = i;
  }
  Candidate chosen;
  chosen.depth_m = depths_m[(first + end) / 2];  // the median
  for (const Candidate& candidate : candidates) {
    if (candidate.depth_m < depths_m[first] || candidate.depth_m > depths_m[end - 1]) continue;
    chosen.color = candidate.color;
    break;
  }
  return chosen;
}

/// Of the sources by time, those nearest to the target's first.
std::vector<WarpedView> WarpAll(const Warper& warper, std::int64_t stamp_ns,
                                std::span<const std::shared_ptr<const StaticView>> sources) {
  std::vector<std::shared_ptr<const StaticView>> by_time(sources.begin(), sources.end());
  std::stable_sort(by_time.begin(), by_time.end(), [&](const auto& a, const auto& b) {
    return std::llabs(a->stamp_ns - stamp_ns) < std::llabs(b->stamp_ns - stamp_ns);
  });
  std::vector<WarpedView> views;
  for (const auto& source : by_time) views.push_back(warper.Warp(*source));
  return views;
}

/// Gives the surface at each hidden pixel that views show, to `take`.
template <class Take>
void FillHidden(const std::vector<WarpedView>& views, const cv::Mat& hidden,
                const InpaintingOptions& options, Take&& take) {
  std::vector<Candidate> candidates;
  for (int row = 0; row < hidden.rows; ++row) {
    for (int column = 0; column < hidden.cols; ++column) {
      if (hidden.at<std::uint8_t>(row, column) == 0) continue;
      GatherCandidates(views, row, column, candidates);
      if (!candidates.empty()) {
        take(cv::Point(column, row), ChooseSurface(candidates, options));
      }
    }
  }
}

}  // namespace

BackgroundInpainter::BackgroundInpainter(const PinholeCamera& camera,
                                         const KeyframeCloudOptions& cloud,
                                         const InpaintingOptions& options)
    : camera_(camera), cloud_(cloud), options_(options), table_(camera) {}

/// Empty where the point is not in the image.
std::optional<cv::Vec3b> BackgroundInpainter::FindColor(
    const cv::Mat& color, const Eigen::Vector3d& point_in_camera) const {
  if (point_in_camera.z() <= 0) return {};
  const Eigen::Vector2d pixel = camera_.Project(point_in_camera);
  const Eigen::Array2i nearest = pixel.array().round().cast<int>();
  if (!cv::Rect({}, color.size()).contains({nearest.x(), nearest.y()})) return {};
  return color.at<cv::Vec3b>(nearest.y(), nearest.x());
}

StaticView BackgroundInpainter::MakeStaticView(const SceneView& view) const {
  StaticView result{view.stamp_ns, {}, {}};
  const RigidTransform color_from_world = view.world_from_camera.Inverse();
  LabelledFrame frame;
  frame.depth_m = view.depth_m;
  frame.dynamic_mask = view.hidden;
  const cv::Mat usable = FindUsablePixels(frame, cloud_);
  for (int row = 0; row < usable.rows; ++row) {
    for (int column = 0; column < usable.cols; ++column) {
      if (usable.at<std::uint8_t>(row, column) == 0) continue;
      const Eigen::Vector3d point =
          view.world_from_depth * camera_.UnprojectIdeal(table_.At(column, row).cast<double>(),
                                                         view.depth_m.at<float>(row, column));
      const auto color = FindColor(view.color, color_from_world * point);
      if (!color) continue;
      result.points_in_world.push_back(point.cast<float>());
      result.colors.push_back(*color);
    }
  }
  return result;
}

InpaintedFrame BackgroundInpainter::Inpaint(
    const SceneView& target, std::span<const std::shared_ptr<const StaticView>> sources) const {
  OFM_CHECK(target.hidden.size() == target.color.size() &&
            target.depth_m.size() == target.color.size());
  InpaintedFrame frame{target.color.clone(), target.depth_m.clone(),
                       FindDynamicPixels(target.hidden, target.depth_m, cloud_),
                       cv::Mat::zeros(target.hidden.size(), CV_8UC1)};
  frame.color.setTo(0, frame.hidden);
  frame.depth_m.setTo(0, frame.hidden);
  if (cv::countNonZero(frame.hidden) == 0) return frame;
  const auto fill = [&](const RigidTransform& world_from_target, auto&& take) {
    const Warper warper(camera_, target, world_from_target, frame.hidden);
    FillHidden(WarpAll(warper, target.stamp_ns, sources), frame.hidden, options_, take);
  };
  fill(target.world_from_camera, [&](const cv::Point& pixel, const Candidate& surface) {
    frame.color.at<cv::Vec3b>(pixel) = surface.color;
  });
  fill(target.world_from_depth, [&](const cv::Point& pixel, const Candidate& surface) {
    frame.depth_m.at<float>(pixel) = surface.depth_m;
    frame.filled.at<std::uint8_t>(pixel) = 255;
  });
  return frame;
}

}  // namespace ofm
