// OpenCV's failures as one line of an Error.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace ofm {

/// The first line of OpenCV's reason, without its source file.
inline std::string ReasonOf(const cv::Exception& exception) {
  return exception.err.substr(0, exception.err.find('\n'));
}

}  // namespace ofm
