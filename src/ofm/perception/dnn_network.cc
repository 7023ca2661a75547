#include "ofm/perception/dnn_network.h"

#include <fmt/format.h>

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/io/read_file.h"
#include "ofm/perception/onnx_header.h"
#include "ofm/perception/opencv_failure.h"

namespace ofm {
namespace {

/// Width and height of the image input of `bytes`; `wanted` goes first where it is not empty.
cv::Size FindInputSize(const std::string& bytes, const std::filesystem::path& path,
                       cv::Size wanted) {
  const std::vector<OnnxInput> inputs = ReadOnnxInputs(bytes, path);
  const std::vector<std::int64_t>& shape = inputs.front().shape;
  if (inputs.size() != 1 || shape.size() != 4 || (shape[1] != 3 && shape[1] != 0)) {
    throw Error(path, "does not take one colour image (1 x 3 x height x width); export it so");
  }
  if (!wanted.empty()) return wanted;
  constexpr std::int64_t kMaxSide = 4096;
  if (shape[2] < 1 || shape[3] < 1 || shape[2] > kMaxSide || shape[3] > kMaxSide) {
    throw Error(path, "leaves its input size open; set perception.input_width and input_height");
  }
  return {static_cast<int>(shape[3]), static_cast<int>(shape[2])};
}

}  // namespace

DnnNetwork::DnnNetwork(const std::filesystem::path& path, cv::Size input) : path_(path) {
  if (path.empty()) {
    throw Error("no network given; set perception.model (--model) to an ONNX file");
  }
  const std::string bytes = ReadFile(path);
  input_ = FindInputSize(bytes, path, input);
  try {
    net_ = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
    net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    output_names_ = net_.getUnconnectedOutLayersNames();
  } catch (const cv::Exception& exception) {
    throw Error(path, "OpenCV cannot load this network: " + ReasonOf(exception));
  }
  if (output_names_.empty()) throw Error(path, "is a network without outputs; export it again");
  Run(cv::Mat(input_, CV_8UC3, cv::Scalar::all(128)));
}

void DnnNetwork::Run(const cv::Mat& image) {
  OFM_CHECK(image.type() == CV_8UC3 && image.size() == input_);
  try {
    net_.setInput(cv::dnn::blobFromImage(image, 1.0 / 255, input_, cv::Scalar(), true));
    net_.forward(outputs_, output_names_);
  } catch (const cv::Exception& exception) {
    throw Error(path_, fmt::format("OpenCV cannot run this network at {} x {} px: {}", input_.width,
                                   input_.height, ReasonOf(exception)));
  }
}

}  // namespace ofm
