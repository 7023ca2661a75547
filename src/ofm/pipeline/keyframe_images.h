// Small pictures of some key frames, for people to look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "ofm/pipeline/run_observer.h"

namespace ofm {

struct KeyframeImage {
  std::int64_t stamp_ns = 0;
  std::vector<unsigned char> jpeg;
};

/// Keeps at most `max_count` pictures, evenly over the key frames of a run whose length it does not
/// know: whenever there are more, every second one goes, and only half as many are taken from then
/// on. Each is 240 px wide, with the dynamic mask in red and instances outlined: about 10 kB, and
/// under 1 ms of CPU time.
class KeyframeImages : public RunObserver {
 public:
  explicit KeyframeImages(std::size_t max_count) : max_count_(max_count) {}

  void OnFrame(const FrameReport& report) override;

  /// In order of time.
  const std::vector<KeyframeImage>& images() const { return images_; }

 private:
  std::size_t max_count_, seen_ = 0, stride_ = 1;
  std::vector<KeyframeImage> images_;
};

/// Writes folder/STAMP.jpg for each picture; pictures of an earlier run are removed, and the folder
/// too where there is no new one. Throws Error where a file cannot be written.
void WriteKeyframeImages(const std::filesystem::path& folder,
                         const std::vector<KeyframeImage>& images);

}  // namespace ofm
