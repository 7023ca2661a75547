// OpenCV's failures as one line of an Error.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <string>

namespace ofm {

/// OpenCV logs what it also throws; silent while this lives, in the whole process.
class ScopedOpenCvSilence {
 public:
  ScopedOpenCvSilence()
      : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~ScopedOpenCvSilence() { cv::utils::logging::setLogLevel(level_); }
  ScopedOpenCvSilence(const ScopedOpenCvSilence&) = delete;
  ScopedOpenCvSilence& operator=(const ScopedOpenCvSilence&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
};

/// The first line of OpenCV's reason, without its source file.
inline std::string ReasonOf(const cv::Exception& exception) {
  return exception.err.substr(0, exception.err.find('\n'));
}

}  // namespace ofm
