// Colours that tell classes apart.
#pragma once

#include "ofm/dense/dense_options.h"
#include "ofm/dense/labelled_point.h"

namespace ofm {

/// Of what has no class: light grey.
inline constexpr Rgb kUnlabelledColor = {200, 200, 200};

/// The colour of a class in label images: those of the PASCAL VOC challenge's colour map, whose
/// entry 0 is the background and entry N + 1 class N; kUnlabelledColor for kNoLabel.
Rgb LabelColor(std::uint8_t class_id);

/// What something of this appearance and class is drawn with.
inline Rgb ChooseColor(MapColor color, Rgb appearance, std::uint8_t class_id) {
  return color == MapColor::kLabel ? LabelColor(class_id) : appearance;
}

}  // namespace ofm
