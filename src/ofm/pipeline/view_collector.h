// What frames between keyframes add to the semantic map.
#pragma once

#include <vector>

#include "ofm/dense/labelled_frame.h"
#include "ofm/map/map.h"
#include "ofm/pipeline/front_end.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// Keeps every `stride`-th frame with a pose until the next keyframe is made, which takes them into
/// its cloud: what people hid there, they may not have hidden a moment before. Where no keyframe
/// comes for long, as a camera that stands still needs none, views are thinned out evenly in time,
/// so that there are never more than kMaxViews. Serves one thread.
class ViewCollector {
 public:
  static constexpr std::size_t kMaxViews = 32;

  explicit ViewCollector(int stride) : stride_(stride), stride_now_(stride) {}

  /// A frame that became no keyframe.
  void Add(const PreparedFrame& prepared, const TrackingResult& result);

  /// Gives the views that lie in the keyframe's sub-map, as `map` now has their poses, and begins
  /// anew.
  std::vector<LabelledFrame> Take(const KeyframeCandidate& keyframe, const MapSnapshot& map);

 private:
  struct View {
    LabelledFrame frame;  // in its own camera
    KeyframeId reference;
    RigidTransform camera_from_reference;
  };

  void ThinOut();

  int stride_, stride_now_;  // since the last keyframe
  int frames_ = 0;           // since the last view or keyframe
  std::vector<View> views_;
};

}  // namespace ofm
