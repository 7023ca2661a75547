// The light of a scene: lamps, and what falls from them on what stands still.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace ofm {

/// A rectangle below a ceiling that shines downwards.
struct Lamp {
  Eigen::Vector3d centre_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector2d half_extent_m = Eigen::Vector2d::Constant(0.3);  ///< along x and y
  double intensity = 1;  ///< light on a surface that faces it 1 m below it
};

struct Lighting {
  std::vector<Lamp> lamps;
  double ambient = 0.35;  ///< from everywhere, as light between surfaces is
};

/// Light over a rectangle, a value for each of a grid's nodes, interpolated between them. 1 shows a
/// texture's own colour.
class LightMap {
 public:
  /// `values` row by row, `columns` along u; nodes are at the rectangle's edges and evenly between.
  LightMap(int columns, int rows, const Eigen::Vector2f& half_extent_m, std::vector<float> values)
      : columns_(columns),
        rows_(rows),
        half_extent_m_(half_extent_m),
        cells_per_m_(0.5F * static_cast<float>(columns - 1) / half_extent_m.x(),
                     0.5F * static_cast<float>(rows - 1) / half_extent_m.y()),
        values_(std::move(values)) {}

  /// At (u, v) from the rectangle's middle [m].
  float At(float u_m, float v_m) const {
    const float x = std::clamp((u_m + half_extent_m_.x()) * cells_per_m_.x(), 0.0F,
                               static_cast<float>(columns_ - 1) - 1e-3F);
    const float y = std::clamp((v_m + half_extent_m_.y()) * cells_per_m_.y(), 0.0F,
                               static_cast<float>(rows_ - 1) - 1e-3F);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float fx = x - static_cast<float>(column);
    const float fy = y - static_cast<float>(row);
    const float* above = values_.data() + row * columns_ + column;
    const float* below = above + columns_;
    return (1 - fy) * ((1 - fx) * above[0] + fx * above[1]) +
           fy * ((1 - fx) * below[0] + fx * below[1]);
  }

 private:
  int columns_, rows_;
  Eigen::Vector2f half_extent_m_, cells_per_m_;
  std::vector<float> values_;
};

/// Light maps by (part, face). Parts are counted through all bodies in their order. Faces of a box
/// are 0 to 5: 2 * axis, and 1 more on its positive side; a rectangle has the face 0.
using BakedLight = std::map<std::pair<int, int>, LightMap>;

}  // namespace ofm
