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
  /// Loads `path` and runs it once on a grey image. `input` replaces the input's size in the file
  /// and is needed where the file leaves it open; empty = as the file says. Throws Error where the
  /// file is missing, no network, or uses what OpenCV cannot run; OpenCV then also logs, where the
  /// process has not silenced it (cv::utils::logging::setLogLevel).
  explicit DnnNetwork(const std::filesystem::path& path, cv::Size input = {});

  cv::Size input_size() const { return input_; }
  const std::filesystem::path& path() const { return path_; }

  /// Runs the network on a BGR image (CV_8UC3, input_size()), which it gets as RGB / 255. Throws
  /// Error where OpenCV fails.
  void Run(const cv::Mat& image);

  /// All outputs of the last run in the file's order; good until the next run.
  const std::vector<cv::Mat>& outputs() const { return outputs_; }

 private:
  std::filesystem::path path_;
  cv::Size input_;
  cv::dnn::Net net_;
  std::vector<std::string> output_names_;
  std::vector<cv::Mat> outputs_;
};

}  // namespace ofm
