#include "ofm/features/feature_grid.h"

namespace ofm {

FeatureGrid::FeatureGrid(std::span<const Eigen::Vector2f> points_px, int width, int height)
    : columns_((width + kCellPx - 1) / kCellPx), rows_((height + kCellPx - 1) / kCellPx) {
  const auto cell_of = [&](const Eigen::Vector2f& p) {
    return Row(p.y()) * columns_ + Column(p.x());
  };
  starts_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (const Eigen::Vector2f& point : points_px) ++starts_[cell_of(point) + 1];
  for (std::size_t cell = 1; cell < starts_.size(); ++cell) starts_[cell] += starts_[cell - 1];
  indices_.resize(points_px.size());
  std::vector<std::uint32_t> next = starts_;
  for (std::size_t i = 0; i < points_px.size(); ++i) {
    indices_[next[cell_of(points_px[i])]++] = static_cast<int>(i);
  }
}

}  // namespace ofm
