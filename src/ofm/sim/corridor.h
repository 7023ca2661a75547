// A furnished floor of a house.
#pragma once

#include "ofm/sim/furnished_plan.h"

namespace ofm {

/// A corridor of 12 m and three rooms beside it: meeting room, office, lounge. Doorways join all of
/// them, so that tours close loops. The viewpoint is in the office and looks at its desk; that
/// office's door to the corridor opens before people.
Scene MakeCorridor(const FurnishedPlan& plan);

}  // namespace ofm
