#include "ofm/objects/object_hypothesis.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ofm {

void ObjectHypothesis::Add(PlacedObservation observation) {
  VoxelTable filled;
  for (const Eigen::Vector3f& point : observation.points_in_world) {
    const std::optional<VoxelIndex> voxel = FindVoxel(point, 1 / voxel_m_);
    if (!voxel) continue;
    const std::size_t known = filled.size();
    if (filled.Insert(*voxel) < known) continue;
    const std::uint32_t number = voxels_.Insert(*voxel);
    if (number == counts_.size()) counts_.push_back(0);
    ++counts_[number];
    bounds_.extend(*voxel);
  }
  float& best = views_[observation.keyframe];
  best = std::max(best, observation.score);
  class_weights_[observation.class_id] += observation.score;
  observations_.push_back(std::move(observation));
}

void ObjectHypothesis::Absorb(const ObjectHypothesis& other) {
  for (const PlacedObservation& observation : other.observations_) Add(observation);
}

/// Of one or two observations each voxel counts; of more, one is no proof.
int ObjectHypothesis::MinCount() const {
  constexpr int kFew = 2, kProof = 3;
  constexpr double kShare = 0.2;
  const auto count = static_cast<int>(observations_.size());
  if (count <= kFew) return 1;
  return std::clamp(static_cast<int>(std::ceil(kShare * count)), 2, kProof);
}

bool ObjectHypothesis::FillsNear(const VoxelIndex& voxel) const {
  static const std::array<VoxelIndex, 7> kSteps{
      VoxelIndex(0, 0, 0),  VoxelIndex(1, 0, 0), VoxelIndex(-1, 0, 0), VoxelIndex(0, 1, 0),
      VoxelIndex(0, -1, 0), VoxelIndex(0, 0, 1), VoxelIndex(0, 0, -1)};
  return std::any_of(kSteps.begin(), kSteps.end(), [&](const VoxelIndex& step) {
    const std::optional<std::uint32_t> number = voxels_.Find(voxel + step);
    return number && Counts(*number);
  });
}

bool ObjectHypothesis::IsNear(const ObjectHypothesis& other) const {
  Eigen::AlignedBox3i grown = bounds_;
  if (grown.isEmpty() || other.bounds_.isEmpty()) return false;
  grown.min().array() -= 1;
  grown.max().array() += 1;
  return grown.intersects(other.bounds_);
}

double ObjectHypothesis::ShareIn(const ObjectHypothesis& other) const {
  if (!IsNear(other)) return 0;
  int all = 0, shared = 0;
  for (std::uint32_t number = 0; number < counts_.size(); ++number) {
    if (!Counts(number)) continue;
    ++all;
    if (other.FillsNear(voxels_.At(number))) ++shared;
  }
  return all == 0 ? 0 : static_cast<double>(shared) / all;
}

int ObjectHypothesis::Size() const {
  return static_cast<int>(std::count_if(counts_.begin(), counts_.end(),
                                        [&](int count) { return count >= MinCount(); }));
}

std::vector<Eigen::Vector3f> ObjectHypothesis::Centers() const {
  std::vector<Eigen::Vector3f> centers;
  for (const std::uint32_t number : voxels_.SortedNumbers()) {
    if (Counts(number)) centers.push_back(VoxelCenter(voxels_.At(number), voxel_m_));
  }
  return centers;
}

Spread ObjectHypothesis::FindSpread() const {
  const std::vector<Eigen::Vector3f> centers = Centers();
  Spread spread;
  if (centers.empty()) return spread;
  const auto count = static_cast<double>(centers.size());
  for (const Eigen::Vector3f& center : centers) spread.center += center.cast<double>() / count;
  double square_sum = 0;
  for (const Eigen::Vector3f& center : centers) {
    square_sum += (center.cast<double>() - spread.center).squaredNorm();
  }
  spread.radius_m = std::sqrt(square_sum / count);
  return spread;
}

std::vector<Eigen::Vector3f> ObjectHypothesis::Points() const {
  std::vector<Eigen::Vector3f> points;
  for (const PlacedObservation& observation : observations_) {
    for (const Eigen::Vector3f& point : observation.points_in_world) {
      const std::optional<VoxelIndex> voxel = FindVoxel(point, 1 / voxel_m_);
      if (voxel && Counts(*voxels_.Find(*voxel))) points.push_back(point);
    }
  }
  return points;
}

ClassId ObjectHypothesis::BestClass() const {
  const auto best =
      std::max_element(class_weights_.begin(), class_weights_.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == class_weights_.end() ? ClassId() : best->first;
}

double ObjectHypothesis::Weight() const {
  double sum = 0;
  for (const auto& [id, weight] : class_weights_) sum += weight;
  return sum;
}

bool ObjectHypothesis::IsLikely(ClassId class_id) const {
  const auto weight = class_weights_.find(class_id);
  return weight != class_weights_.end() && weight->second >= Weight() / 4;
}

bool ObjectHypothesis::SawIn(KeyframeId keyframe, ClassId class_id) const {
  return std::any_of(observations_.begin(), observations_.end(), [&](const auto& observation) {
    return observation.keyframe == keyframe && observation.class_id == class_id;
  });
}

}  // namespace ofm
