#include "ofm/perception/optical_flow.h"

#include <opencv2/core.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>

#include "ofm/base/check.h"

namespace ofm {
namespace {

cv::Size WindowOf(const OpticalFlowOptions& options) {
  return {options.window_px, options.window_px};
}

/// A header onto the points' memory, as OpenCV wants them. The points are not written to.
cv::Mat AsMat(std::span<const Eigen::Vector2f> points) {
  static_assert(sizeof(Eigen::Vector2f) == 2 * sizeof(float));
  return cv::Mat(static_cast<int>(points.size()), 1, CV_32FC2,
                 const_cast<Eigen::Vector2f*>(points.data()));
}

/// Lucas–Kanade one way; found[i] tells whether point i was found.
std::vector<Eigen::Vector2f> Follow(const FlowPyramid& from, const FlowPyramid& to,
                                    std::span<const Eigen::Vector2f> points,
                                    const OpticalFlowOptions& options,
                                    std::vector<std::uint8_t>& found) {
  const int last_level = static_cast<int>(from.levels.size()) / 2 - 1;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, options.iterations,
                              options.epsilon_px);
  cv::Mat moved;
  cv::calcOpticalFlowPyrLK(from.levels, to.levels, AsMat(points), moved, found, cv::noArray(),
                           WindowOf(options), last_level, stop);
  const auto* begin = moved.ptr<Eigen::Vector2f>();
  return {begin, begin + moved.total()};
}

bool IsInside(const Eigen::Vector2f& point, cv::Size size) {
  return point.x() >= 0 && point.y() >= 0 && point.x() <= static_cast<float>(size.width - 1) &&
         point.y() <= static_cast<float>(size.height - 1);
}

/// Marks the points that, tracked back, do not return.
void CheckBackward(const FlowPyramid& previous, const FlowPyramid& current,
                   const OpticalFlowOptions& options, FlowResult& flow) {
  std::vector<std::size_t> indices;
  std::vector<Eigen::Vector2f> points;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    if (!flow.IsTracked(i)) continue;
    indices.push_back(i);
    points.push_back(flow.current[i]);
  }
  if (points.empty()) return;
  std::vector<std::uint8_t> found;
  const auto back = Follow(current, previous, points, options, found);
  const auto limit = static_cast<float>(options.forward_backward_px);
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const bool returns = found[k] != 0 && (back[k] - flow.previous[indices[k]]).norm() <= limit;
    if (!returns) flow.status[indices[k]] = FlowStatus::kInconsistent;
  }
}

}  // namespace

FlowPyramid BuildFlowPyramid(const cv::Mat& gray, const OpticalFlowOptions& options) {
  OFM_CHECK(gray.type() == CV_8UC1 && !gray.empty());
  FlowPyramid pyramid{{}, gray.size()};
  constexpr bool kWithGradients = true, kMayKeepInput = false;
  cv::buildOpticalFlowPyramid(gray, pyramid.levels, WindowOf(options), options.levels - 1,
                              kWithGradients, cv::BORDER_REFLECT_101, cv::BORDER_CONSTANT,
                              kMayKeepInput);
  return pyramid;
}

FlowResult TrackPoints(const FlowPyramid& previous, const FlowPyramid& current,
                       std::span<const Eigen::Vector2f> points, const OpticalFlowOptions& options) {
  OFM_CHECK(!previous.levels.empty() && previous.size == current.size);
  FlowResult flow;
  if (points.empty()) return flow;
  flow.previous.assign(points.begin(), points.end());
  std::vector<std::uint8_t> found;
  flow.current = Follow(previous, current, points, options, found);
  flow.status.assign(points.size(), FlowStatus::kTracked);
  for (std::size_t i = 0; i < flow.size(); ++i) {
    if (found[i] == 0 || !IsInside(flow.current[i], current.size)) {
      flow.status[i] = FlowStatus::kLost;
    }
  }
  if (options.forward_backward_px > 0) CheckBackward(previous, current, options, flow);
  return flow;
}

FlowResult OpticalFlow::Advance(const cv::Mat& gray, std::span<const Eigen::Vector2f> points) {
  const FlowPyramid previous = std::exchange(pyramid_, BuildFlowPyramid(gray, options_));
  if (previous.levels.empty() || previous.size != pyramid_.size) return {};
  return TrackPoints(previous, pyramid_, points, options_);
}

}  // namespace ofm
