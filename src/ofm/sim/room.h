// A furnished room, with people and boxes that move if wanted.
#pragma once

#include <cstdint>

#include "ofm/base/options.h"
#include "ofm/sim/scene.h"

namespace ofm {

struct RoomOptions {
  double width_m = 6, depth_m = 5, height_m = 2.6;  ///< along x, y and z
  int people = 0;                 ///< who walk to and fro between the viewpoint and its target
  int carried_boxes = 0;          ///< class "box", which move likewise
  double mover_distance_m = 1.1;  ///< of the nearest mover's path from the viewpoint
  double mover_period_s = 5;      ///< to and fro of the slowest

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("width_m", self.width_m, "size along x [m]", Range{4, 50});
    visit("depth_m", self.depth_m, "size along y [m]", Range{4, 50});
    visit("height_m", self.height_m, "size along z [m]", Range{2.2, 10});
    visit("people", self.people, "people who walk before the camera", Range{0, 20});
    visit("carried_boxes", self.carried_boxes, "boxes that move before the camera", Range{0, 20});
    visit("mover_distance_m", self.mover_distance_m,
          "distance of the nearest mover's path from the viewpoint [m]", Range{0.3, 20});
    visit("mover_period_s", self.mover_period_s, "to and fro of the slowest mover [s]",
          Range{0.5, 1000});
  }
};

/// A room around the world's origin, its floor at z = 0, with a desk, shelves, a chair, pictures
/// and clutter. The same (options, seed) give the same room. The viewpoint looks along +y at the
/// desk; a circle of 1.2 m about the origin is free.
Scene MakeRoom(const RoomOptions& options, std::uint64_t seed);

}  // namespace ofm
