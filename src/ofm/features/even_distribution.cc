#include "ofm/features/even_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "ofm/base/check.h"

namespace ofm {

void DropWeakWhereStrong(std::vector<Corner>& corners, int strong_score, int cell_size) {
  int columns = 0, rows = 0;
  for (const Corner& corner : corners) {
    columns = std::max(columns, corner.x / cell_size + 1);
    rows = std::max(rows, corner.y / cell_size + 1);
  }
  std::vector<std::uint8_t> has_strong(static_cast<std::size_t>(columns) * rows, 0);
  const auto cell = [&](const Corner& c) { return c.y / cell_size * columns + c.x / cell_size; };
  for (const Corner& corner : corners) {
    if (corner.score >= strong_score) has_strong[cell(corner)] = 1;
  }
  std::erase_if(corners, [&](const Corner& corner) {
    return corner.score < strong_score && has_strong[cell(corner)] != 0;
  });
}

void EvenSelector::SortByScore(std::span<const Corner> corners) {
  std::array<int, 257> starts{};
  int right = 0, bottom = 0;
  left_ = top_ = 1 << 16;
  for (const Corner& corner : corners) {
    ++starts[256 - std::min<int>(corner.score, 255)];
    left_ = std::min<int>(left_, corner.x);
    top_ = std::min<int>(top_, corner.y);
    right = std::max<int>(right, corner.x);
    bottom = std::max<int>(bottom, corner.y);
  }
  width_ = right - left_ + 1;
  height_ = bottom - top_ + 1;
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  sorted_.resize(corners.size());
  for (const Corner& corner : corners) {
    sorted_[starts[255 - std::min<int>(corner.score, 255)]++] = corner;
  }
}

/// Keeps the strongest corners of which no other is within two cells; at most `count_limit`.
int EvenSelector::Cover(int cell_size, int count_limit) {
  constexpr int kReach = 2;
  const int columns = width_ / cell_size + 1 + 2 * kReach;
  const int rows = height_ / cell_size + 1 + 2 * kReach;
  is_covered_.assign(static_cast<std::size_t>(columns) * rows, 0);
  kept_.clear();
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    const int column = (sorted_[i].x - left_) / cell_size + kReach;
    const int row = (sorted_[i].y - top_) / cell_size + kReach;
    if (is_covered_[row * columns + column] != 0) continue;
    kept_.push_back(static_cast<int>(i));
    if (static_cast<int>(kept_.size()) > count_limit) break;
    for (int y = row - kReach; y <= row + kReach; ++y) {
      std::fill_n(&is_covered_[y * columns + column - kReach], 2 * kReach + 1, std::uint8_t{1});
    }
  }
  return static_cast<int>(kept_.size());
}

std::vector<Corner> EvenSelector::Select(std::span<const Corner> corners, int count) {
  if (count <= 0 || corners.empty()) return {};
  SortByScore(corners);
  if (static_cast<int>(sorted_.size()) <= count) return sorted_;
  // The largest cell that leaves enough; 0 stands for no suppression at all.
  int enough = 0, too_large = std::max(width_, height_) + 1;
  const int count_limit = count + count / 10;
  best_.clear();
  while (too_large - enough > 1) {
    const int cell_size = (enough + too_large) / 2;
    const int kept = Cover(cell_size, count_limit);
    if (kept < count) {
      too_large = cell_size;
      continue;
    }
    enough = cell_size;
    best_ = kept_;
    if (kept <= count_limit) break;
  }
  if (best_.empty()) {
    best_.resize(count);
    std::iota(best_.begin(), best_.end(), 0);
  }
  std::vector<Corner> selected;
  for (int i = 0; i < count; ++i) selected.push_back(sorted_[best_[i]]);
  return selected;
}

std::vector<int> AllocateCounts(std::span<const int> available, std::span<const double> weights,
                                int total) {
  OFM_CHECK(available.size() == weights.size());
  std::vector<int> counts(available.size(), 0);
  // From the last list to the first, each gets its share of what is left; what the first ones lack
  // goes round again.
  for (bool has_progress = true; has_progress && total > 0;) {
    has_progress = false;
    double weight_left = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (counts[i] < available[i]) weight_left += weights[i];
    }
    for (std::size_t i = weights.size(); i-- > 0;) {
      if (counts[i] >= available[i]) continue;
      const int share = static_cast<int>(std::ceil(total * weights[i] / weight_left));
      const int given = std::min({share, available[i] - counts[i], total});
      weight_left -= weights[i];
      counts[i] += given;
      total -= given;
      has_progress = has_progress || given > 0;
      if (total == 0) break;
    }
  }
  return counts;
}

}  // namespace ofm
