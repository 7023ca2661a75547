// The plots of a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ofm/report/plot.h"
#include "ofm/report/report_data.h"

namespace ofm {

enum class FigureKind { kPlan, kXyz, kAte, kRpe, kTiming, kCulled, kMap };

/// The kinds' names: plan, xyz, ate, rpe, timing, culled, map.
std::optional<FigureKind> ParseFigureKind(const std::string& name);
std::vector<std::string> FigureKindNames();

/// Plots of one kind for all runs that have what it needs.
struct Figure {
  std::vector<Plot> plots;
  std::optional<BarChart> bars;
  std::vector<std::string> missing;  ///< what is not there and how to get it, a sentence each

  bool empty() const { return plots.empty() && !bars; }
};

/// Beyond this many runs colours would repeat.
inline constexpr std::size_t kMaxRuns = 6;

Figure MakeFigure(FigureKind kind, const ReportData& data);

/// The drawings of a figure, one below the other; throws Error that says what is missing where
/// there is none.
std::string FigureToSvg(const Figure& figure);

}  // namespace ofm
