#include "ofm/dynamics/instance_motion.h"

#include <algorithm>

#include "ofm/base/check.h"

namespace ofm {

InstanceEvidence CountEvidence(const cv::Mat& flow_evidence, const cv::Mat& mask) {
  InstanceEvidence evidence;
  if (flow_evidence.empty()) return evidence;
  OFM_CHECK(flow_evidence.size() == mask.size());
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const float said = flow_evidence.at<float>(y, x);
      if (mask.at<std::uint8_t>(y, x) == 0 || said == 0) continue;
      ++evidence.cells;
      evidence.moving += said > 0;
    }
  }
  return evidence;
}

double UpdateInstanceMotion(double before, const InstanceEvidence& evidence, double elapsed_s,
                            const InstanceMotionOptions& options) {
  if (evidence.cells < options.min_cells) return before;
  const double share = static_cast<double>(evidence.moving) / evidence.cells;
  double now = before;
  if (share > options.moving_share) now += options.moving_log_odds;
  if (share < options.static_share) now -= options.static_log_odds_per_s * elapsed_s;
  return std::clamp(now, -options.limit, options.limit);
}

}  // namespace ofm
