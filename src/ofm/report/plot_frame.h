// What plots have in common: title, legend, axes.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ofm/report/axis_scale.h"
#include "ofm/report/plot_svg.h"

namespace ofm {

inline constexpr double kPlotWidth_px = 480;

/// Distance of lines of text [px].
inline constexpr double kPlotLine_px = 20;

/// Room around the axes: right, above, and below for numbers and label [px].
inline constexpr double kPlotRight_px = 14, kPlotTop_px = 10, kPlotBottom_px = 44;

/// What is read out instead of a plot.
std::string PlotAlternative(const std::string& title, const std::string& description);

/// Says how high the drawing is [px]; a standalone one gets a size and white ground.
void SetPlotHeight(pugi::xml_node svg, double height_px, SvgUse use);

/// Adds what a drawing begins with: its style and title, where it stands alone. Gives the height
/// that they take [px].
double AddPlotHead(pugi::xml_node svg, const std::string& title, SvgUse use);

/// An entry of a legend: a stroke's classes and what it means.
using LegendEntry = std::pair<std::string, std::string>;

/// Adds rows of entries from `top` down and gives the height that they take [px]; none for a single
/// entry, which the title explains.
double AddLegend(pugi::xml_node svg, const std::vector<LegendEntry>& entries, double top);

/// The rectangle between a plot's axes [px].
struct PlotArea {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// Adds grid lines, numbers and the label of the horizontal axis.
void AddHorizontalAxis(pugi::xml_node svg, const PlotArea& area, const LinearScale& scale,
                       const std::string& label);

/// The same of the vertical axis.
void AddVerticalAxis(pugi::xml_node svg, const PlotArea& area, const LinearScale& scale,
                     const std::string& label);

/// Width of the numbers and the label on the left of a plot [px].
double VerticalAxisWidth(const Interval& values, double height_px);

}  // namespace ofm
