#include "ofm/dense/label_color.h"

namespace ofm {

Rgb LabelColor(std::uint8_t class_id) {
  if (class_id == kNoLabel) return kUnlabelledColor;
  // Every third bit of the number goes to one channel, the lowest becoming the highest there.
  Rgb color;
  unsigned bits = class_id + 1U;
  for (int shift = 7; shift >= 0; --shift, bits >>= 3) {
    color.r |= static_cast<std::uint8_t>((bits & 1) << shift);
    color.g |= static_cast<std::uint8_t>((bits >> 1 & 1) << shift);
    color.b |= static_cast<std::uint8_t>((bits >> 2 & 1) << shift);
  }
  return color;
}

}  // namespace ofm
