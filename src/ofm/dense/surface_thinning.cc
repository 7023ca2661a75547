#include "ofm/dense/surface_thinning.h"

#include <algorithm>
#include <cmath>

#include "ofm/dense/voxel_lookup.h"

namespace ofm {
namespace {

constexpr double kKernelVoxels = 1.5, kKernelSigmas = 2;
/// On a surface that is seen aslant, what is beside the line of sight is before or behind, too.
constexpr double kBesideVoxels = .25;
/// Beyond it things are different things, whatever the noise.
constexpr double kMaxKernel_m = .04;
constexpr double kReachKernels = 2;
constexpr int kShifts = 3;

/// The voxels of a cloud, found by where they are.
class VoxelField {
 public:
  VoxelField(std::span<const FusedVoxel> voxels, double resolution_m)
      : voxels_(voxels), resolution_m_(resolution_m), lookup_(resolution_m) {
    // Rounding can put a mean into the next voxel, which then has two: the first counts.
    for (const FusedVoxel& voxel : voxels) lookup_.Add(voxel.point.position);
  }

  /// Where on the line of sight through `voxel` most was measured.
  Eigen::Vector3f FindSurface(const FusedVoxel& voxel) const {
    Eigen::Vector3f position = voxel.point.position;
    const Eigen::Vector3f direction = (position - voxel.viewpoint).normalized();
    if (!direction.allFinite()) return position;
    const double sigma_m = 1 / std::sqrt(voxel.point.precision);
    const double kernel_m =
        std::min(std::max(kKernelVoxels * resolution_m_, kKernelSigmas * sigma_m), kMaxKernel_m);
    for (int i = 0; i < kShifts; ++i) {
      position += direction * static_cast<float>(MeanOffset(position, direction, kernel_m));
    }
    return position;
  }

 private:
  double MeanOffset(const Eigen::Vector3f& position, const Eigen::Vector3f& direction,
                    double kernel_m) const {
    const int steps = static_cast<int>(std::ceil(kReachKernels * kernel_m / resolution_m_));
    double weights = 0, offsets = 0;
    std::optional<std::size_t> last;
    for (int step = -steps; step <= steps; ++step) {
      const Eigen::Vector3f place = position + direction * static_cast<float>(step * resolution_m_);
      const auto found = lookup_.Find(place);
      if (!found || found == last) continue;
      last = found;
      const FusedVoxel& voxel = voxels_[*found];
      const Eigen::Vector3f way = voxel.point.position - position;
      const double offset_m = direction.dot(way);
      const double beside_m = (way - direction * static_cast<float>(offset_m)).norm();
      const double along = offset_m / kernel_m;
      const double beside = beside_m / (kBesideVoxels * resolution_m_);
      const double weight = voxel.precision * std::exp(-.5 * (along * along + beside * beside));
      weights += weight;
      offsets += weight * offset_m;
    }
    return weights > 0 ? offsets / weights : 0;
  }

  std::span<const FusedVoxel> voxels_;
  double resolution_m_;
  VoxelLookup lookup_;
};

/// What comes into one voxel.
struct Gathered {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double precision = 0, most = 0;
  LabelledPoint point;  // the one with most precision
};

}  // namespace

std::vector<LabelledPoint> ThinSurfaces(std::span<const FusedVoxel> voxels, double resolution_m) {
  const VoxelField field(voxels, resolution_m);
  VoxelTable numbers;
  std::vector<Gathered> gathered;
  for (const FusedVoxel& voxel : voxels) {
    const Eigen::Vector3f position = field.FindSurface(voxel);
    const auto index = FindVoxel(position, 1 / resolution_m);
    if (!index) continue;
    const std::uint32_t number = numbers.Insert(*index);
    if (number == gathered.size()) gathered.emplace_back();
    Gathered& into = gathered[number];
    into.position += voxel.precision * position.cast<double>();
    into.precision += voxel.precision;
    if (voxel.precision <= into.most) continue;
    into.most = voxel.precision;
    into.point = voxel.point;
  }
  std::vector<LabelledPoint> points;
  points.reserve(gathered.size());
  for (const Gathered& one : gathered) {
    points.push_back(one.point);
    points.back().position = (one.position / one.precision).cast<float>();
  }
  return points;
}

}  // namespace ofm
