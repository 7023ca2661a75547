// Plots of how a run went: what it culled, and how long it took.
#pragma once

#include "ofm/report/figures.h"

namespace ofm {

/// Masked share of the pixels over time [%].
Figure CulledFigure(const ReportData& data);

/// CPU time by stage, median and 99th percentile, and of each frame over time [ms].
Figure TimingFigure(const ReportData& data);

}  // namespace ofm
