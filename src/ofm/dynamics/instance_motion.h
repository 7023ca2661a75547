// Whether an instance moves, by evidence gathered over time.
#pragma once

#include <map>
#include <opencv2/core.hpp>

#include "ofm/base/ids.h"
#include "ofm/base/options.h"

namespace ofm {

struct InstanceMotionOptions {
  double presumed_log_odds = 2;      ///< of an instance of a class that may move, when first seen
  double moving_share = 0.5;         ///< of an instance's textured cells that move: so does it
  double static_share = 0.15;        ///< fewer: it stands still
  double moving_log_odds = 2;        ///< added by a frame that shows it moving
  double static_log_odds_per_s = 3;  ///< taken off per second that shows it standing still
  double limit = 4;                  ///< of the absolute value
  int min_cells = 20;                ///< fewer textured cells say nothing
  double standing_weight = 0.1;      ///< of what belongs to one that stands still, at most

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("presumed_log_odds", self.presumed_log_odds,
          "of an instance of a class that may move, when first seen", Range{-10, 10});
    visit("moving_share", self.moving_share, "of the textured cells that makes it move",
          Range{0, 1});
    visit("static_share", self.static_share, "of the textured cells under which it stands still",
          Range{0, 1});
    visit("moving_log_odds", self.moving_log_odds, "added by a frame that shows it moving",
          Range{0, 10});
    visit("static_log_odds_per_s", self.static_log_odds_per_s,
          "taken off per second that shows it standing still", Range{0, 100});
    visit("limit", self.limit, "of the log-odds' absolute value", Range{0, 20});
    visit("min_cells", self.min_cells, "fewer textured cells say nothing", Range{1, 10000});
    visit("standing_weight", self.standing_weight,
          "of the features on one that stands still, at most; 1 = as any others", Range{0, 1});
  }
};

/// How much of an instance its flow shows to move.
struct InstanceEvidence {
  int cells = 0;   ///< with texture and depth
  int moving = 0;  ///< of these, against the camera's motion
};

/// Counts `flow_evidence` (CV_32FC1 log-odds, 0 = says nothing) under `mask` (CV_8UC1).
InstanceEvidence CountEvidence(const cv::Mat& flow_evidence, const cv::Mat& mask);

/// The log-odds that an instance moves after a frame with such evidence (CFP-SLAM, Hu et al. 2022,
/// judges people by their motion too): quick to believe that it moves, slow that it stands still.
double UpdateInstanceMotion(double before, const InstanceEvidence& evidence, double elapsed_s,
                            const InstanceMotionOptions& options);

/// Log-odds of moving by track.
using InstanceMotions = std::map<InstanceId, double>;

}  // namespace ofm
