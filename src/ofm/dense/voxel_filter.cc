#include "ofm/dense/voxel_filter.h"

namespace ofm {

void VoxelFilter::Add(const LabelledPoint& point) {
  const std::optional<VoxelIndex> voxel = FindVoxel(point.position, voxels_per_metre_);
  if (!voxel) return;
  const std::uint32_t number = table_.Insert(*voxel);
  if (number == sums_.size()) sums_.emplace_back();
  Sum& sum = sums_[number];
  sum.position += point.position.cast<double>();
  sum.color += Eigen::Vector3i(point.color.r, point.color.g, point.color.b);
  ++sum.count;
  sum.votes.Add(point.class_id, point.confidence);
}

std::vector<LabelledPoint> VoxelFilter::Points() const {
  std::vector<LabelledPoint> points;
  points.reserve(sums_.size());
  for (const Sum& sum : sums_) {
    const auto mean = [&](int channel) {
      return static_cast<std::uint8_t>((sum.color[channel] + sum.count / 2) / sum.count);
    };
    points.push_back({(sum.position / sum.count).cast<float>(),
                      {mean(0), mean(1), mean(2)},
                      sum.votes.Best(),
                      sum.votes.Confidence()});
  }
  return points;
}

}  // namespace ofm
