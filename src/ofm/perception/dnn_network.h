// An ONNX network run by OpenCV, with its failures turned into Error.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <string>
#include <vector>

namespace ofm {

/// A network with one image input. One object serves one thread at a time. How many threads OpenCV
/// uses is the process's own setting (cv::setNumThreads); the outputs do not depend on it.
class DnnNetwork {
 public:
  /// Loads `path`. `input` replaces the input's size in the file and is needed where the file
  /// leaves it open; empty = as the file says. Throws Error where the file is missing, no network,
  /// or uses what OpenCV cannot run. While it loads, OpenCV's log level is lowered for the whole
  /// process: the error says what the log would have said.
  explicit DnnNetwork(const std::filesystem::path& path, cv::Size input = {});

  cv::Size input_size() const { return input_; }
  const std::filesystem::path& path() const { return path_; }

  /// Runs the network on a BGR image (CV_8UC3, input_size()) given to it as RGB / 255. Returns all
  /// outputs, in the file's order, valid until the next call. Throws Error where OpenCV fails.
  std::vector<cv::Mat> Forward(const cv::Mat& image);

 private:
  std::filesystem::path path_;
  cv::Size input_;
  cv::dnn::Net net_;
  std::vector<std::string> output_names_;
};

}  // namespace ofm
