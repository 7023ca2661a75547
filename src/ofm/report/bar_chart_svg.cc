#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "ofm/report/plot_frame.h"
#include "ofm/report/plot_svg.h"
#include "ofm/report/svg.h"

namespace ofm {
namespace {

constexpr double kBar_px = 12, kGroupGap_px = 10, kValue_px = 44;

std::vector<LegendEntry> LegendOf(const BarChart& chart) {
  std::vector<LegendEntry> legend;
  for (std::size_t i = 0; i < chart.runs.size(); ++i) {
    legend.emplace_back(fmt::format("line run{}", i), chart.runs[i]);
  }
  return legend;
}

/// From 0 to the longest bar or whisker.
Interval ValuesOf(const BarChart& chart) {
  Interval values{0, 0};
  for (const BarGroup& group : chart.groups) {
    for (const BarGroup::Bar& bar : group.bars) {
      Include(values, bar.value);
      Include(values, bar.whisker);
    }
  }
  values.min = 0;
  if (values.max <= 0) values.max = 1;
  return values;
}

/// The rectangle of the bars, below `top`.
PlotArea AreaOf(const BarChart& chart, double top) {
  double names_px = 0, height_px = 0;
  for (const BarGroup& group : chart.groups) {
    names_px = std::max(names_px, SvgTextWidth(group.name));
    height_px += kBar_px * static_cast<double>(group.bars.size()) + kGroupGap_px;
  }
  return {24 + names_px, top, kPlotWidth_px - kPlotRight_px - kValue_px, top + height_px};
}

void AddBar(pugi::xml_node svg, const BarGroup::Bar& bar, const LinearScale& scale, double y) {
  const std::string color = fmt::format("run{}", bar.run);
  const double left = scale(0), middle = y + kBar_px / 2, end = scale(bar.value);
  const double whisker_end = std::max(end, scale(bar.whisker));
  AddSvgRectangle(svg, fmt::format("bar {}", color), {left, y + 1},
                  {std::max(end - left, 0.5), kBar_px - 2});
  AddSvgLine(svg, fmt::format("whisker {}", color).c_str(), {end, middle}, {whisker_end, middle});
  AddSvgText(svg, "value", {whisker_end + 5, middle + 4}, SvgAnchor::kStart,
             fmt::format("{:.3g}", bar.value));
}

}  // namespace

std::string PlotToSvg(const BarChart& chart, SvgUse use) {
  pugi::xml_document document;
  pugi::xml_node svg =
      AddSvg(document, {kPlotWidth_px, 1}, PlotAlternative(chart.title, chart.description));
  double top = kPlotTop_px + AddPlotHead(svg, chart.title, use);
  top += AddLegend(svg, LegendOf(chart), top);
  const PlotArea area = AreaOf(chart, top);
  const LinearScale scale(ValuesOf(chart), area.left, area.right);
  AddHorizontalAxis(svg, area, scale, chart.x_label);
  double y = top + kGroupGap_px / 2;
  for (const BarGroup& group : chart.groups) {
    const double bars_px = kBar_px * static_cast<double>(group.bars.size());
    AddSvgText(svg, "tick", {area.left - 8, y + bars_px / 2 + 4}, SvgAnchor::kEnd, group.name);
    for (const BarGroup::Bar& bar : group.bars) {
      AddBar(svg, bar, scale, y);
      y += kBar_px;
    }
    y += kGroupGap_px;
  }
  SetPlotHeight(svg, area.bottom + kPlotBottom_px, use);
  return SvgText(document);
}

}  // namespace ofm
