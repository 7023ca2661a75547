#include "ofm/features/image_patch.h"

#include <cmath>

namespace ofm {

float ImagePatch::At(const Eigen::Vector2f& offset) const {
  const float x = offset.x() + kRadius, y = offset.y() + kRadius;
  const float left = std::floor(x), top = std::floor(y);
  if (!(left >= 0 && top >= 0 && left + 1 < kSize && top + 1 < kSize)) return -1;
  const std::uint8_t* upper = gray.data() + static_cast<int>(top) * kSize + static_cast<int>(left);
  const std::uint8_t* lower = upper + kSize;
  const float u = x - left, v = y - top;
  return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

}  // namespace ofm
