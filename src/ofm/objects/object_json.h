// Objects as JSON; docs/objects.md describes it.
#pragma once

#include <string>

#include "ofm/objects/scene_object.h"

namespace ofm {

/// All of an inventory; ends in a newline. Lengths are rounded to 0.1 mm.
std::string ObjectsJson(const ObjectInventory& inventory);

}  // namespace ofm
