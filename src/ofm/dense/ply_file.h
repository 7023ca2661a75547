// Labelled clouds as PLY files.
#pragma once

#include <ostream>
#include <span>
#include <string>

#include "ofm/dense/labelled_point.h"

namespace ofm {

/// Writes a binary little-endian PLY: per vertex x y z (float, [m]), red green blue, label (the
/// class id, 255 = none) and confidence (255 = sure), all uchar. The class names stand in the
/// header as "comment label ID NAME". Throws Error where writing fails.
void WritePly(std::ostream& stream, std::span<const LabelledPoint> cloud,
              std::span<const std::string> class_names);

}  // namespace ofm
