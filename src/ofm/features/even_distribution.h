// Chooses corners that are strong and lie evenly over the image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ofm {

/// A corner of one pyramid level, in its pixels.
struct Corner {
  std::uint16_t x = 0, y = 0;
  std::uint16_t score = 0;
  bool operator==(const Corner&) const = default;
};

/// Drops corners under `strong_score` in square cells that have one of that score or over. Keeps
/// the order.
void DropWeakWhereStrong(std::vector<Corner>& corners, int strong_score, int cell_size);

/// Largest score of a corner that EvenSelector tells apart.
inline constexpr int kMaxCornerScore = 4095;

/// Chooses some corners for even coverage and the others for their strength. Coverage is by
/// suppression in squares (Bailo et al., "Efficient adaptive non-maximal suppression algorithms for
/// homogeneous spatial keypoint distribution", 2018): going from the strongest down, a corner is
/// kept unless a kept one lies within a radius, which is searched such that as many remain as are
/// wanted. Keeps buffers between calls.
class EvenSelector {
 public:
  /// `count` corners, or all where there are fewer, in decreasing order of score (then in the order
  /// given). The share `evenness` (0 to 1) of them is chosen for coverage.
  std::vector<Corner> Select(std::span<const Corner> corners, int count, double evenness);

 private:
  void SortByScore(std::span<const Corner> corners);
  int Cover(int cell_size, int count_limit);
  void ChooseForCoverage(int count);

  std::vector<Corner> sorted_;
  std::vector<std::uint8_t> is_covered_, is_chosen_;
  std::vector<int> kept_, best_;
  int left_ = 0, top_ = 0, width_ = 0, height_ = 0;
};

/// How many of `total` each of some lists gives: in proportion to `weights`, no list more than it
/// has; what one lacks goes to the others.
std::vector<int> AllocateCounts(std::span<const int> available, std::span<const double> weights,
                                int total);

}  // namespace ofm
