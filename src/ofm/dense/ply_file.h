// Labelled clouds as PLY files.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "ofm/dense/dense_options.h"
#include "ofm/dense/labelled_point.h"

namespace ofm {

/// Writes a binary little-endian PLY: per vertex x y z (float, [m]), red green blue, label (the
/// class id, 255 = none) and confidence (255 = sure), all uchar, and instance (ushort, 65535 =
/// none). The class names stand in the header as "comment label ID NAME". Throws Error where
/// writing fails.
void WritePly(std::ostream& stream, std::span<const LabelledPoint> cloud,
              std::span<const std::string> class_names, MapColor color = MapColor::kAppearance);

/// Reads a file that WritePly wrote; class names are left out. Throws Error that names the file:
/// missing, of other fields, or of another length than its header says.
std::vector<LabelledPoint> LoadPly(const std::filesystem::path& path);

}  // namespace ofm
