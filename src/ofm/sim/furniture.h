// Furniture and what lies on it. Every function adds bodies that stand still, named as COCO does.
#pragma once

#include "ofm/sim/scene_kit.h"

namespace ofm {

/// A table top with legs; `world_from_desk` is at its middle on the floor, who sits there looks
/// along +y. `size_m` is the width (x), depth (y) and height.
void AddDesk(SceneKit& kit, const RigidTransform& world_from_desk, const Eigen::Vector3d& size_m);

/// A screen, keyboard, mouse, papers, books, a cup and a bottle for who sits at such a desk.
void AddWorkplace(SceneKit& kit, const RigidTransform& world_from_desk, double desk_height_m);

/// Parts of an office chair that looks along +x; the origin is on the floor below the seat.
std::vector<Part> MakeChair(SceneKit& kit);

/// Height of the seat above the floor [m].
inline constexpr double kSeatHeight_m = 0.47;

/// A bookcase whose back is at the origin, which looks along +x; `size_m` is its depth, width and
/// height.
void AddBookcase(SceneKit& kit, const RigidTransform& world_from_case,
                 const Eigen::Vector3d& size_m);

/// A filing cabinet of three drawers that looks along +x, with a box or a plant on it.
void AddCabinet(SceneKit& kit, const RigidTransform& world_from_cabinet);

/// A plant in a pot.
void AddPlant(SceneKit& kit, const Eigen::Vector3d& position, double height_m);

/// A sofa that looks along +x.
void AddSofa(SceneKit& kit, const RigidTransform& world_from_sofa);

/// A waste bin.
void AddBin(SceneKit& kit, const Eigen::Vector3d& position);

/// A framed print on a wall; `yaw_rad` is the wall's normal.
void AddPicture(SceneKit& kit, Print print, const Eigen::Vector3d& centre, double yaw_rad,
                const Eigen::Vector2d& size_m);

/// A heap of two or three cartons.
void AddCartons(SceneKit& kit, const Eigen::Vector3d& position);

}  // namespace ofm
