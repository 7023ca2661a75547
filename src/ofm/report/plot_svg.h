// Plots as SVG.
#pragma once

#include <span>
#include <string>

#include "ofm/report/plot.h"

namespace ofm {

enum class SvgUse {
  kInPage,      ///< within HTML that has a style for it: follows the page's light or dark theme
  kStandalone,  ///< a file by itself: with a title, and a style for white ground
};

/// 480 px wide; scales without loss. All text is escaped.
std::string PlotToSvg(const Plot& plot, SvgUse use);
std::string PlotToSvg(const BarChart& chart, SvgUse use);

/// Standalone drawings of PlotToSvg below one another, as one.
std::string StackSvg(std::span<const std::string> drawings);

}  // namespace ofm
