// Poses that optimisation has done with for now.
#pragma once

#include "ofm/dense/dense_options.h"
#include "ofm/dense/keyframe_cloud.h"

namespace ofm {

/// Holds a pose back while it changes: the newest key frames move at every local bundle adjustment,
/// and what is integrated before they have come to rest is integrated again at each.
class SettledPoses {
 public:
  /// A pose has settled where it moved by less than `tolerance_m` (see MapShift_m) since the last
  /// update.
  SettledPoses(const DenseOptions& options, double tolerance_m)
      : options_(options), tolerance_m_(tolerance_m) {}

  /// Gives, of the key frames in `world_from_camera`, the last pose that had settled; those that
  /// never had are left out, and so are new ones behind them: the octree takes key frames in order.
  const KeyframePoseMap& Update(const KeyframePoseMap& world_from_camera);

 private:
  DenseOptions options_;
  double tolerance_m_;
  KeyframePoseMap last_, settled_;
};

}  // namespace ofm
