// What an image shows about a key point, kept with the feature.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace ofm {

/// Grey levels about a key point, in pixels of its octave.
struct ImagePatch {
  static constexpr int kRadius = 9;
  static constexpr int kSize = 2 * kRadius + 1;

  Eigen::Vector2f centre_px = Eigen::Vector2f::Zero();  ///< in the full image, distorted
  bool is_whole = true;                                 ///< nothing excluded is in its middle
  std::array<std::uint8_t, kSize * kSize> gray{};       ///< row by row

  /// Grey level between pixels, at an offset from the centre; negative outside.
  float At(const Eigen::Vector2f& offset) const;
};

}  // namespace ofm
