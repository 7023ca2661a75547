#include "ofm/dynamics/dynamics_stage.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/dynamics/epipolar_check.h"
#include "ofm/dynamics/mask_dilation.h"

namespace ofm {
namespace {

bool IsSet(const cv::Mat& mask, const Eigen::Vector2f& point) {
  const int x = static_cast<int>(std::lround(point.x()));
  const int y = static_cast<int>(std::lround(point.y()));
  return x >= 0 && y >= 0 && x < mask.cols && y < mask.rows && mask.at<std::uint8_t>(y, x) != 0;
}

/// Discs with sub-pixel centres.
void AddDiscs(const std::vector<Eigen::Vector2f>& centres, double radius_px, cv::Mat& mask) {
  constexpr int kFractionBits = 4;
  constexpr double kUnits = 1 << kFractionBits;
  for (const Eigen::Vector2f& centre : centres) {
    const cv::Point place(static_cast<int>(std::lround(centre.x() * kUnits)),
                          static_cast<int>(std::lround(centre.y() * kUnits)));
    cv::circle(mask, place, static_cast<int>(std::lround(radius_px * kUnits)), cv::Scalar(255),
               cv::FILLED, cv::LINE_8, kFractionBits);
  }
}

}  // namespace

DynamicsStage::DynamicsStage(const DynamicsOptions& options, const PinholeCamera& camera,
                             const std::vector<std::string>& class_names)
    : options_(options), camera_(camera), policies_(options, class_names) {
  if (options.mode == DynamicsMode::kFull) full_.emplace(options, camera, policies_);
}

DynamicMask DynamicsStage::Process(const DynamicsInput& input) {
  if (full_) return full_->Process(input.frame, input.segmentation, input.step);
  DynamicMask result;
  result.mask = cv::Mat::zeros(input.frame.gray.size(), CV_8UC1);
  if (options_.mode == DynamicsMode::kOff) return result;

  AddInstances(input.segmentation, result.mask);
  FindMovingPoints(input.flow, result);
  AddDiscs(result.dynamic_points, options_.exclusion_radius_px, result.mask);
  result.masked_share =
      static_cast<double>(cv::countNonZero(result.mask)) / static_cast<double>(result.mask.total());
  return result;
}

void DynamicsStage::AddInstances(const Segmentation& segmentation, cv::Mat& mask) const {
  for (const Instance& instance : segmentation.instances) {
    if (!policies_.MayMove(instance.class_id)) continue;
    OFM_CHECK(instance.mask.size() == mask.size());
    AddDilated(instance.mask, options_.dilation_px, mask);
  }
}

/// Off their epipolar lines; off result.mask the static scene is presumed.
void DynamicsStage::FindMovingPoints(const FlowResult& flow, DynamicMask& result) const {
  PointPairs tracked, candidates;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    if (!flow.IsTracked(i)) continue;
    indices.push_back(i);
    tracked.Add(camera_.Undistort(flow.previous[i].cast<double>()),
                camera_.Undistort(flow.current[i].cast<double>()));
    if (IsSet(result.mask, flow.current[i])) continue;
    candidates.Add(tracked.first.back(), tracked.second.back());
  }
  const auto fit = FitFundamental(candidates, options_.epipolar);
  if (!fit) return;
  for (std::size_t k = 0; k < tracked.size(); ++k) {
    const double distance =
        EpipolarDistance(fit->second_from_first, tracked.first[k], tracked.second[k]);
    const std::size_t i = indices[k];
    const bool is_moving = distance > options_.epipolar.threshold_px;
    result.flow.push_back({flow.previous[i], flow.current[i], is_moving});
    if (is_moving) result.dynamic_points.push_back(flow.current[i]);
  }
}

}  // namespace ofm
