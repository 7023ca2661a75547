// A furnished office.
#pragma once

#include "ofm/sim/furnished_plan.h"

namespace ofm {

/// One room of 6.8 m x 6.8 m: two desks in the middle with screens, shelves, cabinets, pictures, a
/// window, a door. The viewpoint looks along +y at the desks, 2.6 m away.
Scene MakeOffice(const FurnishedPlan& plan);

}  // namespace ofm
