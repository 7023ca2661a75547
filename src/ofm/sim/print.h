// Images that are shown once: pictures, screens, doors.
#pragma once

#include <cstdint>

#include "ofm/sim/texture.h"

namespace ofm {

enum class Print {
  kPoster,    ///< a landscape or shapes, with a caption
  kDocument,  ///< lines of text and a figure: notices, papers
  kScreen,    ///< windows with text
  kKeyboard,
  kDoor,    ///< panels and a frame
  kWindow,  ///< the sky and houses outside
};

/// An image that covers `width_m` by `height_m` once, upright where v points up; its middle is at
/// (0, 0).
Texture MakePrint(Print print, double width_m, double height_m, std::uint64_t seed);

}  // namespace ofm
