// What bundle adjustment works on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ofm/estimation/observation.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// A copy of what is to be adjusted, by index.
struct BundleProblem {
  struct Pose {
    RigidTransform camera_from_world;
    bool fixed = false;
  };
  struct Observation {
    int pose = 0;   ///< index into poses
    int point = 0;  ///< index into points_in_world
    PointObservation seen;
  };
  std::vector<Pose> poses;
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<Observation> observations;
};

}  // namespace ofm
