#include "ofm/report/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "ofm/base/error.h"
#include "ofm/report/error_figures.h"
#include "ofm/report/map_figure.h"
#include "ofm/report/plot_svg.h"
#include "ofm/report/run_figures.h"

namespace ofm {
namespace {

constexpr std::array<std::pair<FigureKind, const char*>, 7> kKinds = {{
    {FigureKind::kPlan, "plan"},
    {FigureKind::kXyz, "xyz"},
    {FigureKind::kAte, "ate"},
    {FigureKind::kRpe, "rpe"},
    {FigureKind::kTiming, "timing"},
    {FigureKind::kCulled, "culled"},
    {FigureKind::kMap, "map"},
}};

}  // namespace

std::optional<FigureKind> ParseFigureKind(const std::string& name) {
  for (const auto& [kind, its_name] : kKinds) {
    if (name == its_name) return kind;
  }
  return {};
}

std::vector<std::string> FigureKindNames() {
  std::vector<std::string> names;
  for (const auto& [kind, name] : kKinds) names.emplace_back(name);
  return names;
}

Figure MakeFigure(FigureKind kind, const ReportData& data) {
  switch (kind) {
    case FigureKind::kPlan:
      return PlanFigure(data);
    case FigureKind::kXyz:
      return XyzFigure(data);
    case FigureKind::kAte:
      return AteFigure(data);
    case FigureKind::kRpe:
      return RpeFigure(data);
    case FigureKind::kTiming:
      return TimingFigure(data);
    case FigureKind::kCulled:
      return CulledFigure(data);
    case FigureKind::kMap:
      return MapFigure(data);
  }
  return {};
}

std::string FigureToSvg(const Figure& figure) {
  if (figure.empty()) {
    throw Error(figure.missing.empty() ? "there is nothing to plot" : figure.missing.front());
  }
  std::vector<std::string> drawings;
  for (const Plot& plot : figure.plots) drawings.push_back(PlotToSvg(plot, SvgUse::kStandalone));
  if (figure.bars) drawings.push_back(PlotToSvg(*figure.bars, SvgUse::kStandalone));
  return drawings.size() == 1 ? drawings.front() : StackSvg(drawings);
}

}  // namespace ofm
