// SVG drawings as pictures.
#pragma once

#include <string>

namespace ofm {

/// A PNG of a drawing, `width_px` wide and as high as its shape says. Throws Error where the
/// drawing is no SVG, or too large to draw.
std::string RasterizeSvg(const std::string& svg, int width_px);

}  // namespace ofm
