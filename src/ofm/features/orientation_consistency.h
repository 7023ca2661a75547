// Right matches between two views turn their key points by about the same angle; wrong ones do not.
#pragma once

#include <span>
#include <vector>

namespace ofm {

struct AnglePair {
  float a_rad = 0, b_rad = 0;  ///< any multiple of a turn may be added
};

/// For each pair whether its difference b - a falls into one of the `kept_bins` fullest of `bins`
/// bins of a turn. Of equally full bins those of the smaller angle are kept, and none that holds
/// less than a tenth of the fullest.
std::vector<bool> ConsistentOrientations(std::span<const AnglePair> pairs, int bins = 30,
                                         int kept_bins = 3);

}  // namespace ofm
