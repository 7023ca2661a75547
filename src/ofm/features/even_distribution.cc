#include "ofm/features/even_distribution.h"

#include <algorithm>
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
  std::vector<int> starts(kMaxCornerScore + 2, 0);
  const auto rank = [](const Corner& corner) {
    return kMaxCornerScore - std::min<int>(corner.score, kMaxCornerScore);
  };
  int right = 0, bottom = 0;
  left_ = top_ = 1 << 16;
  for (const Corner& corner : corners) {
    ++starts[rank(corner) + 1];
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
    sorted_[starts[rank(corner)]++] = corner;
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

/// Sets best_ to indices of `count` of sorted_, of which there are more.
void EvenSelector::ChooseForCoverage(int count) {
  // The largest cell that leaves enough; 0 stands for no suppression at all.
  int enough = 0, too_large = std::max(width_, height_) + 1;
  const int count_limit = count + count / 10;
  best_.resize(count);
  std::iota(best_.begin(), best_.end(), 0);
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
  best_.resize(count);
}

std::vector<Corner> EvenSelector::Select(std::span<const Corner> corners, int count,
                                         double evenness) {
  if (count <= 0 || corners.empty()) return {};
  SortByScore(corners);
  if (static_cast<int>(sorted_.size()) <= count) return sorted_;
  ChooseForCoverage(static_cast<int>(std::lround(std::clamp(evenness, 0.0, 1.0) * count)));
  is_chosen_.assign(sorted_.size(), 0);
  for (const int i : best_) is_chosen_[i] = 1;
  int left = count - static_cast<int>(best_.size());
  std::vector<Corner> selected;
  selected.reserve(count);
  for (std::size_t i = 0; i < sorted_.size() && static_cast<int>(selected.size()) < count; ++i) {
    if (is_chosen_[i] == 0 && left-- <= 0) continue;
    selected.push_back(sorted_[i]);
  }
  return selected;
}

std::vector<int> AllocateCounts(std::span<const int> available, std::span<const double> weights,
                                int total) {
  OFM_CHECK(available.size() == weights.size());
  // In order of how soon a growing total exhausts them: what one lacks is then known before the
  // shares of those after it.
  std::vector<std::size_t> order(available.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return available[i] * weights[j] < available[j] * weights[i];
  });
  double weight_left = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<int> counts(available.size(), 0);
  for (const std::size_t i : order) {
    const bool is_last = i == order.back();
    const int share =
        is_last ? total : static_cast<int>(std::lround(total * weights[i] / weight_left));
    counts[i] = std::min(share, available[i]);
    total -= counts[i];
    weight_left -= weights[i];
  }
  return counts;
}

}  // namespace ofm
