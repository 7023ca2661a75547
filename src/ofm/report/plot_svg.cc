#include "ofm/report/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "ofm/base/check.h"
#include "ofm/report/plot_frame.h"
#include "ofm/report/svg.h"
#include "ofm/report/text_encoding.h"

namespace ofm {
namespace {

constexpr double kFreeHeight_px = 210, kLeastHeight_px = 150, kMostHeight_px = 460;

struct Bounds {
  Interval x = EmptyInterval(), y = EmptyInterval();

  void Add(const Eigen::Vector2d& point) {
    if (!point.allFinite()) return;
    Include(x, point.x());
    Include(y, point.y());
  }
};

Bounds BoundsOf(const Plot& plot) {
  Bounds bounds;
  for (const PlotSeries& series : plot.series) {
    for (const Eigen::Vector2d& point : series.points) bounds.Add(point);
  }
  for (const PlotOutline& outline : plot.outlines) {
    for (const Eigen::Vector2d& corner : outline.corners) bounds.Add(corner);
  }
  if (plot.image) {
    bounds.Add({plot.image->x.min, plot.image->y.min});
    bounds.Add({plot.image->x.max, plot.image->y.max});
  }
  const bool equal = plot.shape == PlotShape::kEqualScales;
  bounds.x = Padded(bounds.x, equal ? 0.04 : 0);
  if (plot.baseline == PlotBaseline::kZero && !IsEmpty(bounds.y)) {
    Include(bounds.y, 0);
    const double room = 0.05 * bounds.y.length();
    if (bounds.y.max > 0) bounds.y.max += room;
    if (bounds.y.min < 0) bounds.y.min -= room;
    bounds.y = bounds.y.length() > 0 ? bounds.y : Interval{0, 1};
  } else {
    bounds.y = Padded(bounds.y, 0.05);
  }
  return bounds;
}

/// Widens one of the intervals so that a unit has the same length on both axes; gives the height.
double MakeScalesEqual(Bounds& bounds, double width_px) {
  const double height_px =
      std::clamp(width_px * bounds.y.length() / bounds.x.length(), kLeastHeight_px, kMostHeight_px);
  const double unit_px = std::min(width_px / bounds.x.length(), height_px / bounds.y.length());
  const auto widen = [&](Interval& interval, double length_px) {
    const double half = (length_px / unit_px - interval.length()) / 2;
    interval = {interval.min - half, interval.max + half};
  };
  widen(bounds.x, width_px);
  widen(bounds.y, height_px);
  return height_px;
}

std::string StrokeClass(const PlotSeries& series) {
  return fmt::format("{} {}", series.style == SeriesStyle::kDashed ? "line dashed" : "line",
                     series.color);
}

std::vector<LegendEntry> LegendOf(const Plot& plot) {
  std::vector<LegendEntry> entries;
  for (const PlotSeries& series : plot.series) {
    if (!series.name.empty()) entries.emplace_back(StrokeClass(series), series.name);
  }
  return entries;
}

/// The axes of a plot and where it is in the drawing.
struct Axes {
  LinearScale x, y;

  Eigen::Vector2d operator()(const Eigen::Vector2d& point) const {
    return {x(point.x()), y(point.y())};
  }
};

void AddImage(pugi::xml_node svg, const PlotImage& image, const Axes& axes) {
  const Eigen::Vector2d corner = axes({image.x.min, image.y.max});
  const Eigen::Vector2d size = axes({image.x.max, image.y.min}) - corner;
  pugi::xml_node node = svg.append_child("image");
  node.append_attribute("x") = SvgNumber(corner.x()).c_str();
  node.append_attribute("y") = SvgNumber(corner.y()).c_str();
  node.append_attribute("width") = SvgNumber(size.x()).c_str();
  node.append_attribute("height") = SvgNumber(size.y()).c_str();
  node.append_attribute("preserveAspectRatio") = "none";
  node.append_attribute("href") =
      fmt::format("data:image/png;base64,{}", EncodeBase64(image.png)).c_str();
}

void AddSeries(pugi::xml_node svg, const PlotSeries& series, const Axes& axes) {
  std::vector<Eigen::Vector2d> points_px;
  points_px.reserve(series.points.size());
  for (const Eigen::Vector2d& point : series.points) points_px.push_back(axes(point));
  if (series.style != SeriesStyle::kDots) {
    AddSvgPath(svg, StrokeClass(series), points_px);
    return;
  }
  for (const Eigen::Vector2d& point : points_px) {
    if (!point.allFinite()) continue;
    pugi::xml_node dot = svg.append_child("circle");
    dot.append_attribute("class") = fmt::format("dot {}", series.color).c_str();
    dot.append_attribute("cx") = SvgNumber(point.x()).c_str();
    dot.append_attribute("cy") = SvgNumber(point.y()).c_str();
    dot.append_attribute("r") = "3";
  }
}

void AddOutline(pugi::xml_node svg, const PlotOutline& outline, const Axes& axes) {
  std::string points;
  for (const Eigen::Vector2d& corner : outline.corners) {
    const Eigen::Vector2d pixel = axes(corner);
    points += fmt::format("{},{} ", SvgNumber(pixel.x()), SvgNumber(pixel.y()));
  }
  pugi::xml_node node = svg.append_child("polygon");
  node.append_attribute("class") = "outline";
  node.append_attribute("points") = points.c_str();
}

}  // namespace

std::string PlotToSvg(const Plot& plot, SvgUse use) {
  pugi::xml_document document;
  pugi::xml_node svg =
      AddSvg(document, {kPlotWidth_px, 1}, PlotAlternative(plot.title, plot.description));
  double top = kPlotTop_px + AddPlotHead(svg, plot.title, use);
  top += AddLegend(svg, LegendOf(plot), top);
  Bounds bounds = BoundsOf(plot);
  PlotArea area{VerticalAxisWidth(bounds.y, kFreeHeight_px), top, kPlotWidth_px - kPlotRight_px, 0};
  const bool equal = plot.shape == PlotShape::kEqualScales;
  area.bottom = top + (equal ? MakeScalesEqual(bounds, area.right - area.left) : kFreeHeight_px);
  const Axes axes{{bounds.x, area.left, area.right}, {bounds.y, area.bottom, area.top}};
  if (plot.image) AddImage(svg, *plot.image, axes);
  AddHorizontalAxis(svg, area, axes.x, plot.x_label);
  AddVerticalAxis(svg, area, axes.y, plot.y_label);
  for (const PlotOutline& outline : plot.outlines) AddOutline(svg, outline, axes);
  for (const PlotSeries& series : plot.series) AddSeries(svg, series, axes);
  for (const PlotLabel& label : plot.labels) {
    AddSvgText(svg, "place", axes(label.at) + Eigen::Vector2d(0, 4), SvgAnchor::kMiddle,
               label.text);
  }
  SetPlotHeight(svg, area.bottom + kPlotBottom_px, use);
  return SvgText(document);
}

std::string StackSvg(std::span<const std::string> drawings) {
  pugi::xml_document stack;
  pugi::xml_node root = AddSvg(stack, {kPlotWidth_px, 1}, "");
  std::string alternative;
  double height_px = 0;
  for (const std::string& drawing : drawings) {
    pugi::xml_document document;
    OFM_CHECK(document.load_string(drawing.c_str()));
    pugi::xml_node svg = root.append_copy(document.document_element());
    svg.append_attribute("y") = SvgNumber(height_px).c_str();
    height_px += svg.attribute("height").as_double();
    if (!alternative.empty()) alternative += ' ';
    alternative += svg.attribute("aria-label").value();
  }
  root.attribute("aria-label") = alternative.c_str();
  SetPlotHeight(root, height_px, SvgUse::kStandalone);
  return SvgText(stack);
}

}  // namespace ofm
