// Plots of where the camera was, and of how far off that is.
#pragma once

#include "ofm/report/figures.h"

namespace ofm {

/// The trajectories from above, with the truth.
Figure PlanFigure(const ReportData& data);

/// x, y and z over time, with the truth.
Figure XyzFigure(const ReportData& data);

/// Distance from the truth over time, after alignment [cm].
Figure AteFigure(const ReportData& data);

/// Error of the motion over 1 s [cm, degrees] and per frame [cm], over time.
Figure RpeFigure(const ReportData& data);

/// Breaks a line over time [s] where a point comes later than 0.5 s, and than 5 of the median
/// intervals, after the last one.
std::vector<Eigen::Vector2d> BrokenAtGaps(std::vector<Eigen::Vector2d> points);

}  // namespace ofm
