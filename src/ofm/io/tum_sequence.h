// Recorded sequences in the TUM RGB-D benchmark's folder layout.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/camera/rgbd_frame.h"
#include "ofm/io/frame_source.h"
#include "ofm/io/tum_index.h"

namespace ofm {

/// A TUM RGB-D folder whose frames can be read in any order. Immutable: threads may share it.
class RgbdSequence {
 public:
  /// Reads the lists (ReadTumIndex), not the images.
  RgbdSequence(const std::filesystem::path& folder, const PinholeCamera& camera,
               double max_difference_s = kMaxStampDifference_s);

  std::size_t size() const { return index_.entries.size(); }
  const std::vector<TumEntry>& entries() const { return index_.entries; }
  const PinholeCamera& camera() const { return camera_; }
  const std::filesystem::path& folder() const { return index_.folder; }
  const std::optional<std::filesystem::path>& groundtruth() const { return index_.groundtruth; }

  /// Reads and decodes frame `index` < size(), which is also its id. Throws Error that names the
  /// list, the line and the image: missing, truncated, damaged, of the wrong kind or size.
  RgbdFrame Load(std::size_t index) const;

  /// Throws the same Error for the first of `count` frames from `first` whose files are missing.
  void RequireFiles(std::size_t first, std::size_t count) const;

 private:
  PinholeCamera camera_;
  TumIndex index_;
};

/// Which frames of a sequence are played.
struct FrameRange {
  int first = 0;      ///< index of the first frame
  int max_count = 0;  ///< 0 = all

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("first", self.first, "index of the first frame", Range{0, 1e9});
    visit("max_count", self.max_count, "number of frames at most, 0 = all", Range{0, 1e9});
  }
};

/// Plays a sequence.
class TumFrameSource : public FrameSource {
 public:
  /// Throws Error where a file of the range is missing or the range starts after the end.
  explicit TumFrameSource(std::shared_ptr<const RgbdSequence> sequence, FrameRange range = {});

  std::optional<RgbdFrame> Next() override;
  std::optional<std::size_t> size() const override { return end_ - begin_; }

 private:
  std::shared_ptr<const RgbdSequence> sequence_;
  std::size_t begin_, end_, next_;
};

}  // namespace ofm
