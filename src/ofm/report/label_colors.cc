#include "ofm/report/label_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ofm {

Rgb LabelColor(std::uint8_t class_id) {
  if (class_id == kNoLabel) return kUnlabelledColor;
  // Steps of the golden angle are spread evenly over the hues, however many classes there are.
  constexpr double kGoldenAngle_deg = 137.50776405;
  const double hue = std::fmod(20 + kGoldenAngle_deg * class_id, 360);
  const double lightness = class_id % 2 == 0 ? 0.5 : 0.62, saturation = 0.72;
  // From hue, saturation and lightness (CSS Color Module Level 3, section 4.2.4).
  const double a = saturation * std::min(lightness, 1 - lightness);
  const auto channel = [&](int n) {
    const double k = std::fmod(n + hue / 30, 12);
    const double value = lightness - a * std::max(-1., std::min({k - 3, 9 - k, 1.}));
    return static_cast<std::uint8_t>(std::lround(255 * value));
  };
  return {channel(0), channel(8), channel(4)};
}

std::string HexColor(Rgb color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

}  // namespace ofm
