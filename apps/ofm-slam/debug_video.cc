#include "debug_video.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "ofm/base/error.h"
#include "ofm/io/make_folder.h"
#include "ofm/pipeline/debug_view.h"

namespace ofm {

DebugVideo::DebugVideo(std::filesystem::path path, std::vector<std::string> class_names)
    : path_(std::move(path)), class_names_(std::move(class_names)) {
  if (path_.extension() == ".avi") return;
  if (path_.has_extension()) {
    throw Error(path_, "name an .avi file, or a folder for single frames");
  }
  MakeFolder(path_);
}

void DebugVideo::OnFrame(const FrameReport& report) {
  constexpr double kFramesPerSecond = 30;
  const cv::Mat view = DrawDebugView(report, class_names_);
  if (path_.extension() != ".avi") {
    const auto file = path_ / fmt::format("{:06}.jpg", report.prepared.frame.id.value);
    if (!cv::imwrite(file.string(), view)) throw Error(file, "cannot be written");
    return;
  }
  if (!writer_.isOpened() &&
      !writer_.open(path_.string(), cv::CAP_OPENCV_MJPEG,
                    cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), kFramesPerSecond, view.size())) {
    throw Error(path_, "cannot be written; choose another --debug-video");
  }
  writer_.write(view);
}

}  // namespace ofm
