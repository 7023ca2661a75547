#include "ofm/report/hex_color.h"

#include <fmt/format.h>

namespace ofm {

std::string HexColor(Rgb color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b);
}

}  // namespace ofm
