// What a run keeps of each frame.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ofm/tracking/tracking_types.h"

namespace ofm {

struct FrameRecord {
  std::int64_t stamp_ns = 0;
  TrackingStatus status = TrackingStatus::kWaiting;
  bool is_keyframe = false;   ///< as the tracker asked; mapping may have removed it since
  double masked_share = 0;    ///< of the pixels, 0 to 1
  std::size_t instances = 0;  ///< that the segmenter saw, or that were carried along
  std::size_t features = 0;   ///< outside the mask
  std::size_t inliers = 0;    ///< landmarks that the pose is made of
  friend bool operator==(const FrameRecord&, const FrameRecord&) = default;
};

}  // namespace ofm
