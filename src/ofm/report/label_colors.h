// A colour for each class.
#pragma once

#include <string>

#include "ofm/dense/labelled_point.h"

namespace ofm {

/// Of what has no class.
inline constexpr Rgb kUnlabelledColor = {150, 156, 166};

/// The same for a class in every report; neighbouring ids differ much in hue. kUnlabelledColor for
/// kNoLabel.
Rgb LabelColor(std::uint8_t class_id);

/// "#rrggbb".
std::string HexColor(Rgb color);

}  // namespace ofm
