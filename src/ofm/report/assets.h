// Files that are part of the program, for reports to carry.
#pragma once

#include <string_view>

namespace ofm {

/// The 3-D view with three.js, and their licences: JavaScript in ASCII, without "</script".
std::string_view ViewerScript();
/// The report's looks, light and dark.
std::string_view ReportStyle();
/// The looks of a plot that stands by itself, on white. No CSS variables: librsvg has none.
std::string_view PlotStyle();

}  // namespace ofm
