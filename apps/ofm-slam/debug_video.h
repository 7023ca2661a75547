// Writes debug views as a video or as single frames.
#pragma once

#include <filesystem>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "ofm/pipeline/run_observer.h"

namespace ofm {

/// DrawDebugView of every frame: to PATH.avi (motion JPEG, 30 frames per second), or, where PATH
/// has no extension, to PATH/000000.jpg, PATH/000001.jpg and so on.
class DebugVideo : public RunObserver {
 public:
  /// Throws Error for another extension, or a folder that cannot be made.
  DebugVideo(std::filesystem::path path, std::vector<std::string> class_names);

  /// Throws Error where the file cannot be written.
  void OnFrame(const FrameReport& report) override;

 private:
  std::filesystem::path path_;
  std::vector<std::string> class_names_;
  cv::VideoWriter writer_;
};

}  // namespace ofm
