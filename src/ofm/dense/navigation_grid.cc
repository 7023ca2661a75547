#include "ofm/dense/navigation_grid.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <limits>

#include "ofm/io/atomic_file.h"

namespace ofm {
namespace {

/// Points per voxel and axis: in a turned grid a voxel's centre alone would leave holes.
constexpr int kSamples = 2;

constexpr std::uint8_t Grey(GridCell cell) { return static_cast<std::uint8_t>(cell); }

/// What a voxel at that height tells of its cell; kUnknown = nothing.
GridCell WordOf(double height_m, const SemanticVoxel& voxel, const NavigationOptions& options) {
  if (height_m > options.max_height_m) return GridCell::kUnknown;
  if (height_m >= options.min_height_m) {
    return voxel.IsOccupied() ? GridCell::kOccupied : GridCell::kFree;
  }
  const bool is_floor = height_m > -options.min_height_m && voxel.IsOccupied();
  return is_floor ? GridCell::kFree : GridCell::kUnknown;
}

/// Calls visit(cell, GridCell) for each thing that a voxel tells of a cell.
template <class Visit>
void ForEachWord(const SemanticOctree& octree, const RigidTransform& floor_from_world,
                 const NavigationOptions& options, Visit&& visit) {
  const double side = octree.resolution_m();
  octree.ForEach([&](const VoxelIndex& index, const SemanticVoxel& voxel) {
    const Eigen::Vector3d center = VoxelCenter(index, side).cast<double>();
    for (int i = 0; i < kSamples * kSamples * kSamples; ++i) {
      const Eigen::Array3d step(i % kSamples, i / kSamples % kSamples, i / kSamples / kSamples);
      const Eigen::Vector3d offset = ((step + .5) / kSamples - .5) * side;
      const Eigen::Vector3d point = floor_from_world * Eigen::Vector3d(center + offset);
      const GridCell word = WordOf(point.z(), voxel, options);
      if (word == GridCell::kUnknown) continue;
      visit(Eigen::Vector2i((point.head<2>() / side).array().floor().cast<int>()), word);
    }
  });
}

}  // namespace

RigidTransform FloorFromWorld(const Plane& floor) {
  const Eigen::Vector3d& z = floor.normal;
  const auto in_floor = [&z](const Eigen::Vector3d& axis) -> Eigen::Vector3d {
    return axis - axis.dot(z) * z;
  };
  Eigen::Vector3d x = in_floor(Eigen::Vector3d::UnitZ());
  if (x.norm() < .1) x = in_floor(Eigen::Vector3d::UnitX());
  x.normalize();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), z.cross(x).transpose(), z.transpose();
  return {Eigen::Quaterniond(rotation), Eigen::Vector3d(0, 0, floor.offset_m)};
}

NavigationGrid CutNavigationGrid(const SemanticOctree& octree, const Plane& floor,
                                 const NavigationOptions& options) {
  NavigationGrid grid{octree.resolution_m(), {}, {0, 0}, FloorFromWorld(floor)};
  Eigen::Array2i least = Eigen::Array2i::Constant(std::numeric_limits<int>::max());
  Eigen::Array2i greatest = Eigen::Array2i::Constant(std::numeric_limits<int>::min());
  ForEachWord(octree, grid.floor_from_world, options, [&](const Eigen::Vector2i& cell, GridCell) {
    least = least.min(cell.array());
    greatest = greatest.max(cell.array());
  });
  if (least.x() > greatest.x()) return grid;
  const Eigen::Array2i size = greatest - least + 1;
  grid.origin_m = least.cast<double>() * grid.resolution_m;
  grid.cells = cv::Mat(size.y(), size.x(), CV_8UC1, cv::Scalar(Grey(GridCell::kUnknown)));
  ForEachWord(octree, grid.floor_from_world, options,
              [&](const Eigen::Vector2i& at, GridCell word) {
                auto& cell = grid.cells.at<std::uint8_t>(greatest.y() - at.y(), at.x() - least.x());
                if (cell != Grey(GridCell::kOccupied)) cell = Grey(word);
              });
  return grid;
}

std::optional<NavigationGrid> MakeNavigationGrid(const SemanticOctree& octree,
                                                 const Eigen::Vector3d& up_in_world,
                                                 const NavigationOptions& options) {
  const std::optional<Plane> floor = FindFloor(octree, up_in_world, options.floor);
  if (!floor) return {};
  return CutNavigationGrid(octree, *floor, options);
}

void WriteNavigationGrid(const std::filesystem::path& folder, const NavigationGrid& grid) {
  WriteFileAtomically(folder / "map.pgm", [&](std::ostream& stream) {
    stream << fmt::format("P5\n{} {}\n255\n", grid.cells.cols, grid.cells.rows);
    for (int row = 0; row < grid.cells.rows; ++row) {
      stream.write(grid.cells.ptr<char>(row), grid.cells.cols);
    }
  });
  const Eigen::Vector3d& t = grid.floor_from_world.translation();
  const Eigen::Quaterniond& q = grid.floor_from_world.rotation();
  WriteFileAtomically(
      folder / "map.yaml",
      fmt::format("# floor_from_world (x y z qx qy qz qw): {} {} {} {} {} {} {}\n"
                  "image: map.pgm\nmode: trinary\nresolution: {}\norigin: [{}, {}, 0]\n"
                  "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
                  t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(), grid.resolution_m,
                  grid.origin_m.x(), grid.origin_m.y()));
}

}  // namespace ofm
