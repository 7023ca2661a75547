// A point of a labelled, coloured cloud.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "ofm/dense/labelled_frame.h"

namespace ofm {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend constexpr bool operator==(Rgb, Rgb) = default;
};

/// The nearest colour to (r, g, b), each from 0 to 255.
inline Rgb ToRgb(const Eigen::Vector3d& rgb) {
  const auto channel = [&](int i) { return static_cast<std::uint8_t>(rgb[i] + .5); };
  return {channel(0), channel(1), channel(2)};
}

/// The frame of `position` is said by whatever holds the point.
struct LabelledPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< [m]
  Rgb color;
  std::uint8_t class_id = kNoLabel;
  std::uint8_t confidence = 0;  ///< of class_id, 255 = sure
  /// In a key frame's cloud a number within the frame, in a map's the id of the object in
  /// objects.db; kNoInstance = none.
  std::uint16_t instance = kNoInstance;
  float precision = 1e6F;  ///< 1 / variance of its depth [1/m^2]
};
static_assert(sizeof(LabelledPoint) == 24, "a key frame keeps some ten thousand of them");

}  // namespace ofm
