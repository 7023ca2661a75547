// Labelled clouds as PCD files.
#pragma once

#include <ostream>
#include <span>

#include "ofm/dense/dense_options.h"
#include "ofm/dense/labelled_point.h"

namespace ofm {

/// Writes a binary PCD of version 0.7, as PCL's and Open3D's readers take it: x y z (float, [m]),
/// rgb (uint32, 0x00RRGGBB), label (uint32, the class id, 255 = none), instance (uint16, 65535 =
/// none) and confidence (uint8, 255 = sure). Throws Error where writing fails.
void WritePcd(std::ostream& stream, std::span<const LabelledPoint> cloud,
              MapColor color = MapColor::kAppearance);

}  // namespace ofm
