#include "ofm/report/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ofm/report/assets.h"
#include "ofm/report/svg.h"

namespace ofm {
namespace {

struct Ticks {
  std::vector<double> values;
  double distance = 1;
};

Ticks TicksOf(const Interval& interval, double length_px, double px_per_tick) {
  Ticks ticks;
  ticks.values = NiceTicks(interval, std::clamp(static_cast<int>(length_px / px_per_tick), 2, 9));
  if (ticks.values.size() > 1) ticks.distance = ticks.values[1] - ticks.values[0];
  return ticks;
}

constexpr double kPxPerRow = 36, kPxPerColumn = 64;

}  // namespace

std::string PlotAlternative(const std::string& title, const std::string& description) {
  return description.empty() ? title : title + ". " + description;
}

void SetPlotHeight(pugi::xml_node svg, double height_px, SvgUse use) {
  svg.attribute("viewBox") =
      fmt::format("0 0 {} {}", SvgNumber(kPlotWidth_px), SvgNumber(height_px)).c_str();
  if (use == SvgUse::kInPage) return;
  svg.append_attribute("width") = SvgNumber(kPlotWidth_px).c_str();
  svg.append_attribute("height") = SvgNumber(height_px).c_str();
  // White ground, also where a viewer is dark.
  pugi::xml_node ground = svg.insert_child_before("rect", svg.first_child());
  ground.append_attribute("width") = "100%";
  ground.append_attribute("height") = "100%";
  ground.append_attribute("fill") = "#ffffff";
}

double AddPlotHead(pugi::xml_node svg, const std::string& title, SvgUse use) {
  if (use == SvgUse::kInPage) return 0;
  svg.append_child("style").text() = std::string(PlotStyle()).c_str();
  AddSvgText(svg, "title", {12, 20}, SvgAnchor::kStart, title);
  return 1.5 * kPlotLine_px;
}

double AddLegend(pugi::xml_node svg, const std::vector<LegendEntry>& entries, double top) {
  if (entries.size() < 2) return 0;
  constexpr double kLeft = 12, kStroke = 22, kGap = 16;
  double x = kLeft, y = top + 0.7 * kPlotLine_px;
  for (const auto& [css_class, name] : entries) {
    const double width = kStroke + 6 + SvgTextWidth(name) + kGap;
    if (x > kLeft && x + width - kGap > kPlotWidth_px) x = kLeft, y += kPlotLine_px;
    AddSvgLine(svg, css_class.c_str(), {x, y - 4}, {x + kStroke, y - 4});
    AddSvgText(svg, "legend", {x + kStroke + 6, y}, SvgAnchor::kStart, name);
    x += width;
  }
  return y - top + 0.5 * kPlotLine_px;
}

void AddHorizontalAxis(pugi::xml_node svg, const PlotArea& area, const LinearScale& scale,
                       const std::string& label) {
  const Ticks ticks = TicksOf(scale.values(), area.right - area.left, kPxPerColumn);
  for (const double value : ticks.values) {
    const double x = scale(value);
    AddSvgLine(svg, "grid", {x, area.top}, {x, area.bottom});
    AddSvgText(svg, "tick", {x, area.bottom + 17}, SvgAnchor::kMiddle,
               FormatTick(value, ticks.distance));
  }
  AddSvgLine(svg, "axis", {area.left, area.bottom}, {area.right, area.bottom});
  AddSvgText(svg, "label", {(area.left + area.right) / 2, area.bottom + 36}, SvgAnchor::kMiddle,
             label);
}

void AddVerticalAxis(pugi::xml_node svg, const PlotArea& area, const LinearScale& scale,
                     const std::string& label) {
  const Ticks ticks = TicksOf(scale.values(), area.bottom - area.top, kPxPerRow);
  for (const double value : ticks.values) {
    const double y = scale(value);
    AddSvgLine(svg, "grid", {area.left, y}, {area.right, y});
    AddSvgText(svg, "tick", {area.left - 6, y + 4.5}, SvgAnchor::kEnd,
               FormatTick(value, ticks.distance));
  }
  AddSvgLine(svg, "axis", {area.left, area.top}, {area.left, area.bottom});
  const double middle = (area.top + area.bottom) / 2;
  AddSvgText(svg, "label", {15, middle}, SvgAnchor::kMiddle, label).append_attribute("transform") =
      fmt::format("rotate(-90 15 {})", SvgNumber(middle)).c_str();
}

double VerticalAxisWidth(const Interval& values, double height_px) {
  const Ticks ticks = TicksOf(values, height_px, kPxPerRow);
  double widest = 0;
  for (const double value : ticks.values) {
    widest = std::max(widest, SvgTextWidth(FormatTick(value, ticks.distance)));
  }
  return 32 + widest;
}

}  // namespace ofm
