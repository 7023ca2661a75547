// What the live view's page is told. Text messages are JSON with a "kind"; binary ones begin with a
// letter and three zero bytes, and their numbers are little-endian. web/live/messages.js reads
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ofm/dense/labelled_point.h"
#include "ofm/map/map.h"
#include "ofm/tracking/tracking_types.h"

namespace ofm {

/// How far a run is and how it goes.
struct LiveState {
  std::size_t frames_done = 0;
  std::optional<std::size_t> frames;  ///< in all, where known
  double frames_per_s = 0;
  TrackingStatus status = TrackingStatus::kWaiting;
  int inliers = 0;
  std::size_t keyframes = 0, landmarks = 0;
  double masked_share = 0;                          ///< of the pixels, 0 to 1
  std::optional<RigidTransform> world_from_camera;  ///< empty where it is not known
};

/// What people call a status.
std::string_view NameOf(TrackingStatus status);

/// {"kind": "state", ...}; the pose as the 16 numbers of a matrix, column by column.
std::string EncodeState(const LiveState& state);

/// {"kind": "keyframes", "poses": [[frame id, 16 numbers of world_from_camera], ...]}: those of
/// this run in the sub-map of the newest, by age.
std::string EncodeKeyframes(const MapSnapshot& map);

/// {"kind": "classes", "names": [...]}, by class id.
std::string EncodeClasses(const std::vector<std::string>& class_names);

/// {"kind": "end"}: no more comes.
std::string EncodeEnd();

/// 'I', then the file's bytes.
std::string EncodeImage(std::span<const unsigned char> jpeg);

/// 'C', frame id (u32), count n (u32), places in the camera's frame [mm] (3 n i16; what is further
/// than 32 m is left out), then red, green, blue and label of each (4 n u8, 255 = no label).
std::string EncodeCloud(FrameId frame, const std::vector<LabelledPoint>& points_in_camera);

}  // namespace ofm
