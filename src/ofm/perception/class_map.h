// From a network's own class numbers to those of a list of names.
#pragma once

#include <vector>

#include "ofm/base/ids.h"

namespace ofm {

/// ClassId by label; an invalid id where the label is the background or has no class.
using ClassMap = std::vector<ClassId>;

/// Labels 1 … class_count are the classes in their order; label 0 is the background.
ClassMap MakeContiguousClassMap(int class_count);

/// The labels of COCO's annotation files (1 … 90, with ten gaps), which TensorFlow's and
/// torchvision's networks give, as ids in CocoClassNames(). Label 0 is the background.
ClassMap MakeCoco91ClassMap();

/// The class of `label`; an invalid id where the map has none.
ClassId FindClassOfLabel(const ClassMap& map, int label);

}  // namespace ofm
