// Finds the key points near a place without looking at all of them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace ofm {

/// Point indices by square cells of the plane; points outside the rectangle go to the nearest cell.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  /// The rectangle is [0, width) x [0, height) in pixels.
  FeatureGrid(std::span<const Eigen::Vector2f> points_px, int width, int height);

  /// Calls `visit(index)` for every point of the cells that the square of half side `radius_px`
  /// about `centre_px` touches, in a fixed order. The caller checks the distance.
  template <class Visit>
  void VisitNear(const Eigen::Vector2f& centre_px, float radius_px, Visit&& visit) const {
    if (starts_.empty()) return;
    const int left = Column(centre_px.x() - radius_px), right = Column(centre_px.x() + radius_px);
    const int top = Row(centre_px.y() - radius_px), bottom = Row(centre_px.y() + radius_px);
    for (int row = top; row <= bottom; ++row) {
      const std::uint32_t begin = starts_[row * columns_ + left];
      const std::uint32_t end = starts_[row * columns_ + right + 1];
      for (std::uint32_t i = begin; i < end; ++i) visit(indices_[i]);
    }
  }

 private:
  static constexpr int kCellPx = 16;

  int Column(float x) const { return Clamp(x, columns_); }
  int Row(float y) const { return Clamp(y, rows_); }
  static int Clamp(float coordinate, int cells) {
    if (!(coordinate > 0)) return 0;
    const float cell = coordinate / kCellPx;
    return cell >= static_cast<float>(cells) ? cells - 1 : static_cast<int>(cell);
  }

  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> starts_;  // by cell, row by row, with one past the end
  std::vector<int> indices_;           // of points, by cell
};

}  // namespace ofm
