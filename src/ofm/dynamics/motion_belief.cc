#include "ofm/dynamics/motion_belief.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ofm {
namespace {

/// Depth that may be the same surface a frame later.
constexpr float kSameDepth_m = 0.15F;

/// Where depth begins or ends, so does a surface.
bool MayBeSame(float a_m, float b_m) {
  if (a_m == 0 || b_m == 0) return a_m == b_m;
  return std::abs(a_m - b_m) < kSameDepth_m;
}

/// How strongly two neighbours are tied, 0 to 1.
float Tie(float a_m, float b_m) {
  constexpr float kBothUnknown = 0.3F, kStep_m = 0.03F, kStepPerMetre = 0.02F;
  if (a_m == 0 && b_m == 0) return kBothUnknown;
  if (a_m == 0 || b_m == 0) return 0;
  return std::abs(a_m - b_m) < kStep_m + kStepPerMetre * std::min(a_m, b_m) ? 1.0F : 0.0F;
}

/// Ties of each cell to the next in its row and in its column (0 at the image's end).
struct Ties {
  std::vector<float> right, down;

  explicit Ties(const cv::Mat& depth_m) : right(depth_m.total(), 0), down(depth_m.total(), 0) {
    for (int y = 0; y < depth_m.rows; ++y) {
      for (int x = 0; x < depth_m.cols; ++x) {
        const float here = depth_m.at<float>(y, x);
        const std::size_t i = static_cast<std::size_t>(y) * depth_m.cols + x;
        if (x + 1 < depth_m.cols) right[i] = Tie(here, depth_m.at<float>(y, x + 1));
        if (y + 1 < depth_m.rows) down[i] = Tie(here, depth_m.at<float>(y + 1, x));
      }
    }
  }
};

}  // namespace

cv::Mat CarryBelief(const cv::Mat& last_belief, const LatticeFrame& last,
                    const LatticeFrame& current, const cv::Mat& flow,
                    const BeliefOptions& options) {
  cv::Mat carried(flow.size(), CV_32FC1, cv::Scalar(0));
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec2f step = flow.at<cv::Vec2f>(y, x);
      const int column = static_cast<int>(std::lround(x + step[0]));
      const int row = static_cast<int>(std::lround(y + step[1]));
      if (column < 0 || row < 0 || column >= flow.cols || row >= flow.rows) continue;
      if (!MayBeSame(last.depth_m.at<float>(row, column), current.depth_m.at<float>(y, x)))
        continue;
      carried.at<float>(y, x) =
          static_cast<float>(options.decay) * last_belief.at<float>(row, column);
    }
  }
  return carried;
}

cv::Mat RelaxBelief(const cv::Mat& evidence, const cv::Mat& depth_m, const BeliefOptions& options) {
  const Ties ties(depth_m);
  const auto coupling = static_cast<float>(options.coupling);
  const auto limit = static_cast<float>(options.limit);
  constexpr float kLoudest = 2;  // what a neighbour may say at most
  const int cols = evidence.cols;
  const auto count = static_cast<int>(evidence.total());
  cv::Mat belief = evidence.clone();
  std::vector<float> said(count), heard(count);
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    float* b = belief.ptr<float>();
    for (int i = 0; i < count; ++i) said[i] = std::clamp(b[i], -kLoudest, kLoudest);
    std::fill(heard.begin(), heard.end(), 0.0F);
    for (int i = 0; i + 1 < count; ++i) {
      heard[i] += ties.right[i] * said[i + 1];
      heard[i + 1] += ties.right[i] * said[i];
    }
    for (int i = 0; i + cols < count; ++i) {
      heard[i] += ties.down[i] * said[i + cols];
      heard[i + cols] += ties.down[i] * said[i];
    }
    const float* e = evidence.ptr<float>();
    for (int i = 0; i < count; ++i) b[i] = e[i] + coupling * heard[i];
  }
  return cv::min(cv::max(belief, -limit), limit);
}

}  // namespace ofm
