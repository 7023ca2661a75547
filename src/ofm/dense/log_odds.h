// Probabilities as the octree adds them up.
#pragma once

#include <cmath>

namespace ofm {

/// log(p / (1 - p)) of a probability between 0 and 1.
inline float LogOdds(double probability) {
  return static_cast<float>(std::log(probability / (1 - probability)));
}

}  // namespace ofm
