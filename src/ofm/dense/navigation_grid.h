// A map of where a robot can drive, cut from the octree.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "ofm/dense/floor_plane.h"
#include "ofm/dense/semantic_octree.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// What a cell of the grid shows, as nav2's map_server has it in "trinary" mode.
enum class GridCell : std::uint8_t { kOccupied = 0, kUnknown = 205, kFree = 254 };

struct NavigationGrid {
  double resolution_m = 0;
  cv::Mat cells;  ///< CV_8UC1, GridCell; row 0 has the greatest y
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  ///< lower left corner in the floor's frame
  RigidTransform floor_from_world;                     ///< z is the height over the floor
};

/// The frame of a floor: z along the normal; the origin under the world's, x along the world's z
/// (where the first camera looked) as far as that lies in the floor, otherwise along its x.
RigidTransform FloorFromWorld(const Plane& floor);

/// Cuts the octree between two heights: a cell is occupied where something in the band is, free
/// where the floor itself was seen or a ray freed the band and nothing is in it, and unknown
/// elsewhere. Cells have the voxels' size. Empty cells (0 x 0) where nothing is known.
NavigationGrid CutNavigationGrid(const SemanticOctree& octree, const Plane& floor,
                                 const NavigationOptions& options);

/// Floor and grid of a whole map. `up_in_world`: see FindFloor. Empty where no floor is found.
std::optional<NavigationGrid> MakeNavigationGrid(const SemanticOctree& octree,
                                                 const Eigen::Vector3d& up_in_world,
                                                 const NavigationOptions& options);

/// Writes map.pgm and map.yaml into `folder`, as nav2's map_server reads them. Throws Error.
void WriteNavigationGrid(const std::filesystem::path& folder, const NavigationGrid& grid);

}  // namespace ofm
