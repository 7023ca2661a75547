// The log-odds that a cell moves, over space and time.
#pragma once

#include <opencv2/core.hpp>

#include "ofm/dynamics/motion_options.h"
#include "ofm/perception/lattice_frame.h"

namespace ofm {

/// The last frame's belief where the flow says that the current cells were, decayed; 0 where the
/// depth there was another (something else was seen) or out of sight. CV_32FC1.
cv::Mat CarryBelief(const cv::Mat& last_belief, const LatticeFrame& last,
                    const LatticeFrame& current, const cv::Mat& flow, const BeliefOptions& options);

/// Makes cells agree with their neighbours of continuous depth: options.iterations of
///   b = evidence + coupling · sum over neighbours of clamp(b, -2, 2),
/// a mean-field relaxation of a Markov random field. Cells without depth are joined, more weakly,
/// with one another. The result is within ±options.limit. CV_32FC1.
cv::Mat RelaxBelief(const cv::Mat& evidence, const cv::Mat& depth_m, const BeliefOptions& options);

}  // namespace ofm
