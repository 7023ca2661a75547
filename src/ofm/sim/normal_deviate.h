// Normal deviates that do not depend on the standard library.
#pragma once

#include <cmath>
#include <numbers>

#include "ofm/base/random.h"

namespace ofm {

/// Zero mean, unit variance, by Box and Muller's method (std::normal_distribution differs between
/// libraries).
inline double NormalDeviate(RandomEngine& engine) {
  const double radius = std::sqrt(-2 * std::log(1 - UniformReal(engine)));
  return radius * std::cos(2 * std::numbers::pi * UniformReal(engine));
}

}  // namespace ofm
