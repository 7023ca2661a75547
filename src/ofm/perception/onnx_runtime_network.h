// An ONNX network run by ONNX Runtime, which takes what OpenCV cannot (loops, outputs of a size
// that the image decides). Only in builds where CMake found it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

namespace ofm {

/// One output; of the two spans the one of the tensor's type is used.
struct OnnxTensor {
  enum class Type { kReal, kWhole } type = Type::kReal;
  std::string name;
  std::vector<std::int64_t> shape;
  std::span<const float> reals;
  std::span<const std::int64_t> wholes;
};

/// A network with one input of reals. One object serves one thread at a time. It runs on as many
/// threads as OpenCV did when it was made (cv::getNumThreads).
class OnnxRuntimeNetwork {
 public:
  /// False in a build without ONNX Runtime.
  static bool IsAvailable();

  /// Throws Error where the file is missing or cannot be run, and, in a build without ONNX Runtime,
  /// one that says how to get it.
  explicit OnnxRuntimeNetwork(const std::filesystem::path& path);
  ~OnnxRuntimeNetwork();

  const std::filesystem::path& path() const { return path_; }
  /// Of the input, as in the file: 0 where a dimension is left open.
  const std::vector<std::int64_t>& input_shape() const { return input_shape_; }

  /// Runs the network on `input` (CV_32F, continuous, as many dimensions as input_shape()). Throws
  /// Error where ONNX Runtime fails or an output is neither of reals nor of whole numbers.
  void Run(const cv::Mat& input);

  /// All outputs of the last run in the file's order; good until the next run.
  const std::vector<OnnxTensor>& outputs() const { return outputs_; }

 private:
  struct Session;

  std::filesystem::path path_;
  std::vector<std::int64_t> input_shape_;
  std::unique_ptr<Session> session_;
  std::vector<OnnxTensor> outputs_;
};

}  // namespace ofm
