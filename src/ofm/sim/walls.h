// Walls with doorways and windows, floors and ceilings.
#pragma once

#include <vector>

#include "ofm/sim/scene_kit.h"

namespace ofm {

/// A hole in a wall, along it from where it begins.
struct Opening {
  double from_m = 0, to_m = 1;
  double bottom_m = 0, top_m = 2.05;
};

struct WallPlan {
  Eigen::Vector2d from, to;  ///< of its middle plane
  double height_m = 2.7;
  std::vector<Opening> openings;  ///< in order, apart from one another
  TexturePtr texture;
};

/// A wall of 0.1 m with its openings, lintels, door frames and skirting boards.
void AddWall(SceneKit& kit, const WallPlan& plan);

/// A floor or a ceiling over a rectangle.
struct Slab {
  Eigen::Vector2d from, to;
  double z_m = 0;
  TexturePtr texture;
};
void AddFloor(SceneKit& kit, const Slab& slab);
void AddCeiling(SceneKit& kit, const Slab& slab);

}  // namespace ofm
