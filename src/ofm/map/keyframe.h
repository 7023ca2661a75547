// A frame that the map keeps.
#pragma once

#include <memory>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/features/bag_of_words.h"
#include "ofm/features/frame_features.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

struct Keyframe {
  KeyframeId id;
  FrameId frame_id;  ///< of the run that made it; invalid in a map that was loaded
  std::int64_t stamp_ns = 0;
  SubmapId submap = SubmapId(0);  ///< whose world `camera_from_world` is about
  RigidTransform camera_from_world;
  std::shared_ptr<const FrameFeatures> features;
  std::shared_ptr<const BagOfWords> words;  ///< StaticWords, to recognise the place; may be null
  std::vector<LandmarkId> landmarks;        ///< by feature; invalid where none

  Eigen::Vector3d CenterInWorld() const { return camera_from_world.Inverse().translation(); }
};

}  // namespace ofm
