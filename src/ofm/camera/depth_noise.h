// How much a depth camera's measurement can be trusted.
#pragma once

#include <algorithm>

namespace ofm {

/// Standard deviation [m] of a structured-light camera's depth at `depth_m`: quadratic in depth
/// (Khoshelham and Elberink, Sensors 2012, for the Kinect v1), not under 1 mm.
inline double DepthSigma(double depth_m) {
  constexpr double kSigmaPerSquareMetre = 1.4e-3;
  constexpr double kFloor_m = 1e-3;
  return std::max(kFloor_m, kSigmaPerSquareMetre * depth_m * depth_m);
}

}  // namespace ofm
