// Observations of flat patches, for the tests of how observations are joined. Tests only.
#pragma once

#include "ofm/objects/object_hypothesis.h"

namespace ofm::test {

/// A patch from x = `from` to `to` [m], 0.2 m high, at depth 1 m + `behind`; score 0.8.
inline PlacedObservation Patch(std::uint32_t keyframe, std::uint32_t class_id, double from,
                               double to, double behind = 0) {
  PlacedObservation patch{
      KeyframeId(keyframe), 1'000'000'000LL * keyframe, ClassId(class_id), .8F, {}, {}};
  constexpr double kStep_m = .02;
  for (double x = from + kStep_m / 2; x < to; x += kStep_m) {
    for (double y = kStep_m / 2; y < .2; y += kStep_m) {
      patch.points_in_world.push_back(Eigen::Vector3d(x, y, 1.02 + behind).cast<float>());
    }
  }
  return patch;
}

}  // namespace ofm::test
