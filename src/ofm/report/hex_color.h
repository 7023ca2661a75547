// Colours as CSS and SVG write them.
#pragma once

#include <string>

#include "ofm/dense/labelled_point.h"

namespace ofm {

/// "#rrggbb".
std::string HexColor(Rgb color);

}  // namespace ofm
