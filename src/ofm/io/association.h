// Which measurements of two streams belong together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ofm {

/// The largest difference [s] at which colour, depth and ground truth are taken for simultaneous.
inline constexpr double kMaxStampDifference_s = 0.02;

struct StampPair {
  std::size_t first = 0, second = 0;  ///< indices into the two lists
  friend bool operator==(StampPair, StampPair) = default;
};

/// Pairs stamps [ns] that differ by less than `max_difference_ns`, each at most once, greedily by
/// increasing difference (the rule of the TUM RGB-D benchmark); ties go to the earlier stamps. Both
/// lists must increase. The pairs are in order of `first`.
std::vector<StampPair> AssociateStamps(std::span<const std::int64_t> first,
                                       std::span<const std::int64_t> second,
                                       std::int64_t max_difference_ns);

/// Index of the stamp that is nearest to `stamp_ns`, the earlier of two; `stamps` must increase and
/// not be empty.
std::size_t NearestStamp(std::span<const std::int64_t> stamps, std::int64_t stamp_ns);

}  // namespace ofm
