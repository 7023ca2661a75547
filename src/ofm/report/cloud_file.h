// Labelled clouds from PLY files.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "ofm/dense/labelled_point.h"

namespace ofm {

struct LabelledCloud {
  std::vector<LabelledPoint> points;       ///< in the file's world [m]
  std::size_t points_in_file = 0;          ///< of which `points` are an even choice
  std::map<int, std::string> class_names;  ///< by label
};

/// Reads a binary little-endian PLY: properties x, y, z of its vertices, and where there are any
/// red, green, blue, label and confidence, of any scalar type and in any order; other properties
/// and what comes behind the vertices are skipped. "comment label ID NAME" names a class. Where
/// there are more than `max_points`, every n-th is taken. Points that are not finite are left out.
/// Throws Error with file, and line of the header.
LabelledCloud LoadCloud(const std::filesystem::path& path, std::size_t max_points);

}  // namespace ofm
