#include "ofm/perception/onnx_runtime_network.h"

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/io/read_file.h"

#ifdef OFM_HAS_ONNXRUNTIME

#include <onnxruntime_cxx_api.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "ofm/perception/onnx_header.h"

namespace ofm {
namespace {

/// The first line of ONNX Runtime's reason.
std::string ReasonOf(const Ort::Exception& exception) {
  const std::string reason = exception.what();
  return reason.substr(0, reason.find('\n'));
}

/// Silent: the errors say what the log would have said.
Ort::SessionOptions MakeSessionOptions() {
  Ort::SessionOptions options;
  options.SetIntraOpNumThreads(std::max(cv::getNumThreads(), 1));
  options.SetInterOpNumThreads(1);
  options.SetLogSeverityLevel(ORT_LOGGING_LEVEL_FATAL);
  return options;
}

OnnxTensor ReadTensor(const std::string& name, const Ort::Value& value,
                      const std::filesystem::path& path) {
  const auto info = value.GetTensorTypeAndShapeInfo();
  const std::size_t count = info.GetElementCount();
  OnnxTensor tensor;
  tensor.name = name;
  tensor.shape = info.GetShape();
  if (info.GetElementType() == ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT) {
    tensor.reals = {value.GetTensorData<float>(), count};
  } else if (info.GetElementType() == ONNX_TENSOR_ELEMENT_DATA_TYPE_INT64) {
    tensor.type = OnnxTensor::Type::kWhole;
    tensor.wholes = {value.GetTensorData<std::int64_t>(), count};
  } else {
    throw Error(path,
                "output '" + name + "' is neither of 32-bit reals nor of 64-bit whole numbers");
  }
  return tensor;
}

}  // namespace

struct OnnxRuntimeNetwork::Session {
  explicit Session(const std::string& bytes)
      : session(environment, bytes.data(), bytes.size(), MakeSessionOptions()) {
    Ort::AllocatorWithDefaultOptions allocator;
    for (std::size_t i = 0; i < session.GetInputCount(); ++i) {
      input_names.emplace_back(session.GetInputNameAllocated(i, allocator).get());
    }
    for (std::size_t i = 0; i < session.GetOutputCount(); ++i) {
      output_names.emplace_back(session.GetOutputNameAllocated(i, allocator).get());
    }
    for (const std::string& name : output_names) output_pointers.push_back(name.c_str());
  }

  Ort::Env environment{ORT_LOGGING_LEVEL_FATAL, "ofm"};
  Ort::Session session;
  std::vector<std::string> input_names, output_names;
  std::vector<const char*> output_pointers;
  std::vector<Ort::Value> values;  // the outputs' memory
};

bool OnnxRuntimeNetwork::IsAvailable() { return true; }

OnnxRuntimeNetwork::OnnxRuntimeNetwork(const std::filesystem::path& path) : path_(path) {
  const std::string bytes = ReadFile(path);
  ReadOnnxInputs(bytes, path);  // names a file that ends too early
  try {
    session_ = std::make_unique<Session>(bytes);
    if (session_->input_names.size() != 1) {
      throw Error(path, "does not take one input; export it for one image");
    }
    const Ort::TypeInfo type = session_->session.GetInputTypeInfo(0);
    const auto tensor = type.GetTensorTypeAndShapeInfo();
    if (tensor.GetElementType() != ONNX_TENSOR_ELEMENT_DATA_TYPE_FLOAT) {
      throw Error(path, "does not take 32-bit reals; export it in single precision");
    }
    input_shape_ = tensor.GetShape();
  } catch (const Ort::Exception& exception) {
    throw Error(path, "ONNX Runtime cannot load this network: " + ReasonOf(exception));
  }
  for (std::int64_t& size : input_shape_) size = std::max<std::int64_t>(size, 0);
}

void OnnxRuntimeNetwork::Run(const cv::Mat& input) {
  OFM_CHECK(input.depth() == CV_32F && input.channels() == 1 && input.isContinuous());
  OFM_CHECK(input.dims == std::ssize(input_shape_));
  const std::vector<std::int64_t> shape(input.size.p, input.size.p + input.dims);
  outputs_.clear();
  try {
    const auto memory = Ort::MemoryInfo::CreateCpu(OrtArenaAllocator, OrtMemTypeDefault);
    // ONNX Runtime asks for a pointer that it could write through, and does not.
    const Ort::Value value = Ort::Value::CreateTensor<float>(
        memory, const_cast<float*>(input.ptr<float>()), input.total(), shape.data(), shape.size());
    const char* name = session_->input_names.front().c_str();
    session_->values =
        session_->session.Run(Ort::RunOptions{}, &name, &value, 1, session_->output_pointers.data(),
                              session_->output_pointers.size());
    for (std::size_t i = 0; i < session_->values.size(); ++i) {
      outputs_.push_back(ReadTensor(session_->output_names[i], session_->values[i], path_));
    }
  } catch (const Ort::Exception& exception) {
    throw Error(path_, "ONNX Runtime cannot run this network: " + ReasonOf(exception));
  }
}

}  // namespace ofm

#else

namespace ofm {

struct OnnxRuntimeNetwork::Session {};

bool OnnxRuntimeNetwork::IsAvailable() { return false; }

OnnxRuntimeNetwork::OnnxRuntimeNetwork(const std::filesystem::path& path) : path_(path) {
  ReadFile(path);  // a wrong path is the first thing to say
  throw Error(path,
              "needs ONNX Runtime, without which this program was built: install "
              "libonnxruntime-dev (Debian 13) and build again, or use a TensorFlow graph (.pb) or "
              "--segmenter yolo-seg");
}

void OnnxRuntimeNetwork::Run(const cv::Mat&) { OFM_CHECK(false); }

}  // namespace ofm

#endif

namespace ofm {

OnnxRuntimeNetwork::~OnnxRuntimeNetwork() = default;

}  // namespace ofm
