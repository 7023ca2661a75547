// Colours that tell classes apart.
#pragma once

#include "ofm/dense/labelled_point.h"

namespace ofm {

/// The colour of a class in label images: those of the PASCAL VOC challenge's colour map, whose
/// entry 0 is the background and entry N + 1 class N; light grey for kNoLabel.
Rgb LabelColor(std::uint8_t class_id);

}  // namespace ofm
