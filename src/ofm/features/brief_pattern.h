// The pixel pairs that the binary descriptor compares.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ofm/features/orb_kernels.h"

namespace ofm {

/// Two points relative to the key point [px of its level], within kPatchRadius of it.
struct BriefTest {
  std::int8_t x0, y0, x1, y1;
};

/// Learned by benchmark/learn_brief_pattern.
extern const std::array<BriefTest, 256> kBriefPattern;

/// The pattern turned to evenly spaced orientations, rounded to whole pixels (Rublee et al. 2011,
/// section 4.1).
class PatternRotations {
 public:
  explicit PatternRotations(const std::array<BriefTest, 256>& pattern);

  /// For the orientation nearest to `angle_rad`, which lies in [0, 2 pi].
  const RotatedPattern& At(float angle_rad) const;

 private:
  std::vector<RotatedPattern> rotations_;
};

}  // namespace ofm
