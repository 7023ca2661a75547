// A point of the world that keyframes see.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/features/features.h"

namespace ofm {

struct Landmark {
  struct Observation {
    KeyframeId keyframe;
    int feature = 0;  ///< index in the keyframe
  };

  LandmarkId id;
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3f mean_view = Eigen::Vector3f::Zero();  ///< unit, from the observers to the point
  Descriptor descriptor{};                              ///< of the observations, the most typical
  float min_distance_m = 0, max_distance_m = 0;         ///< at which the pyramid can see it
  KeyframeId first_keyframe;                            ///< the one that made it
  std::vector<Observation> observations;                ///< by increasing keyframe id
  int visible_count = 1;         ///< frames in whose view it should have been
  int found_count = 1;           ///< frames that matched it
  float static_probability = 1;  ///< 0 to 1: how surely it does not move

  /// The feature that `keyframe` sees it by; -1 where it does not.
  int FeatureIn(KeyframeId keyframe) const {
    for (const Observation& o : observations) {
      if (o.keyframe == keyframe) return o.feature;
    }
    return -1;
  }
};

}  // namespace ofm
