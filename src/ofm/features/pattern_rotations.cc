#include <cmath>
#include <numbers>

#include "ofm/base/check.h"
#include "ofm/features/brief_pattern.h"

namespace ofm {
namespace {

constexpr int kOrientations = 256;

std::uint16_t OffsetInPatch(double x, double y, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const auto column = std::lround(c * x - s * y), row = std::lround(s * x + c * y);
  OFM_CHECK(std::abs(column) <= kPatchRadius && std::abs(row) <= kPatchRadius);
  return static_cast<std::uint16_t>((row + kPatchRadius) * 32 + column + kPatchRadius);
}

}  // namespace

PatternRotations::PatternRotations(const std::array<BriefTest, 256>& pattern)
    : rotations_(kOrientations) {
  for (int i = 0; i < kOrientations; ++i) {
    const double angle_rad = 2 * std::numbers::pi * i / kOrientations;
    for (std::size_t test = 0; test < pattern.size(); ++test) {
      const BriefTest& t = pattern[test];
      rotations_[i][test] = {OffsetInPatch(t.x0, t.y0, angle_rad),
                             OffsetInPatch(t.x1, t.y1, angle_rad)};
    }
  }
}

const RotatedPattern& PatternRotations::At(float angle_rad) const {
  constexpr float kStepsPerRadian = kOrientations / (2 * std::numbers::pi_v<float>);
  const auto step = static_cast<unsigned>(std::lround(angle_rad * kStepsPerRadian));
  return rotations_[step % kOrientations];
}

}  // namespace ofm
