// The lists of a TUM RGB-D folder: which images make which frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "ofm/io/association.h"

namespace ofm {

/// An image and the place that names it.
struct ListedImage {
  std::int64_t stamp_ns = 0;
  std::filesystem::path path;  ///< folder included
  std::filesystem::path list;  ///< rgb.txt, depth.txt or associations.txt, folder included
  int line = 0;                ///< in `list`, from 1
};

struct TumEntry {
  ListedImage color, depth;
};

struct TumIndex {
  std::filesystem::path folder;
  std::vector<TumEntry> entries;  ///< by increasing time of the colour image, which is the frame's
  std::optional<std::filesystem::path> groundtruth;  ///< groundtruth.txt, where there is one
};

/// Reads associations.txt ("timestamp colour timestamp depth") where there is one, else rgb.txt and
/// depth.txt ("timestamp file"), which are associated within `max_difference_s`. No image is
/// opened. Throws Error with path and line: no such folder, missing or empty list, wrong number of
/// fields, a time that is no number or does not increase, no pair at all.
TumIndex ReadTumIndex(const std::filesystem::path& folder,
                      double max_difference_s = kMaxStampDifference_s);

}  // namespace ofm
