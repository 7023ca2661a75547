// Where frames come from: a recorded sequence, a simulator, a live camera.
#pragma once

#include <cstddef>
#include <optional>

#include "ofm/camera/rgbd_frame.h"

namespace ofm {

/// Gives frames in increasing order of time. One object serves one thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  /// The next frame; empty at the end. Throws Error where a frame cannot be read: what was read
  /// before stays good, and no further frame comes.
  virtual std::optional<RgbdFrame> Next() = 0;

  /// Number of frames in all; empty where it is not known (live).
  virtual std::optional<std::size_t> size() const = 0;
};

}  // namespace ofm
