#include "ofm/dense/voxel_filter.h"

namespace ofm {

void InstanceVotes::Add(std::uint16_t instance) {
  if (lead_ == 0) instance_ = instance;
  lead_ += instance == instance_ ? 1 : -1;
}

template <class Labels, class Weight>
std::optional<std::uint32_t> BasicVoxelFilter<Labels, Weight>::Add(
    const LabelledPoint& point, const Eigen::Vector3f& viewpoint) {
  const std::optional<VoxelIndex> voxel = FindVoxel(point.position, voxels_per_metre_);
  if (!voxel) return {};
  const std::uint32_t number = NumberOf(*voxel);
  Sum& sum = sums_[number];
  sum.position += static_cast<double>(point.precision) * point.position.template cast<double>();
  sum.viewpoint += static_cast<double>(point.precision) * viewpoint.template cast<double>();
  sum.color += Eigen::Vector3i(point.color.r, point.color.g, point.color.b);
  sum.precision += point.precision;
  ++sum.count;
  sum.labels.Add(point.class_id, weight_(point));
  sum.instances.Add(point.instance);
  return number;
}

/// Neighbours in an image are often of one voxel, so the last one is looked at first.
template <class Labels, class Weight>
std::uint32_t BasicVoxelFilter<Labels, Weight>::NumberOf(const VoxelIndex& voxel) {
  if (voxel == last_voxel_) return last_number_;
  const std::uint32_t number = table_.Insert(voxel);
  if (number == sums_.size()) sums_.emplace_back();
  last_voxel_ = voxel;
  last_number_ = number;
  return number;
}

template <class Labels, class Weight>
LabelledPoint BasicVoxelFilter<Labels, Weight>::Sum::Point() const {
  const auto mean = [&](int channel) {
    return static_cast<std::uint8_t>((color[channel] + count / 2) / count);
  };
  return {(position / precision).template cast<float>(),
          {mean(0), mean(1), mean(2)},
          labels.Best(),
          labels.Confidence(),
          labels.Best() == kNoLabel ? kNoInstance : instances.Best(),
          static_cast<float>(precision / count)};
}

template <class Labels, class Weight>
std::vector<LabelledPoint> BasicVoxelFilter<Labels, Weight>::Points() const {
  std::vector<LabelledPoint> points;
  points.reserve(sums_.size());
  for (const Sum& sum : sums_) points.push_back(sum.Point());
  return points;
}

template <class Labels, class Weight>
std::vector<FusedVoxel> BasicVoxelFilter<Labels, Weight>::Voxels() const {
  std::vector<FusedVoxel> voxels;
  voxels.reserve(sums_.size());
  for (const Sum& sum : sums_) {
    voxels.push_back(
        {sum.Point(), sum.precision, (sum.viewpoint / sum.precision).template cast<float>()});
  }
  return voxels;
}

template class BasicVoxelFilter<LabelVotes, PointConfidence>;
template class BasicVoxelFilter<LabelBelief, PointEvidence>;

}  // namespace ofm
