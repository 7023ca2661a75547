#include "ofm/perception/tensorflow_mask_rcnn.h"

#include <fmt/format.h>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"
#include "ofm/perception/opencv_failure.h"
#include "ofm/perception/protobuf_reader.h"

namespace ofm {
namespace {

const std::vector<cv::String> kOutputNames = {"detection_out_final", "detection_masks"};
constexpr int kCocoClasses = 80, kCoco91Classes = 90;

/// A graph, which is a list of nodes; its reader in OpenCV would say on stderr what is wrong with
/// other files.
std::string ReadGraph(const std::filesystem::path& path) {
  std::string bytes = ReadFile(path);
  constexpr std::uint64_t kGraphNode = 1;
  bool has_node = false;
  try {
    ProtobufReader reader(bytes);
    while (const auto field = reader.Next()) has_node |= field->number == kGraphNode;
  } catch (const MalformedMessage&) {
    has_node = false;
  }
  if (!has_node)
    throw Error(path, "is no frozen TensorFlow graph or ends too early; copy it again");
  return bytes;
}

std::string ReadTextGraph(const std::filesystem::path& path) {
  std::string text = ReadFile(path);
  for (const cv::String& output : kOutputNames) {
    if (text.find('"' + output + '"') == std::string::npos) {
      throw Error(path,
                  fmt::format("is no text graph of a Mask R-CNN: it has no node '{}'; use the "
                              "one that OpenCV publishes for the network",
                              output));
    }
  }
  return text;
}

}  // namespace

TensorflowMaskRcnn::TensorflowMaskRcnn(const TensorflowMaskRcnnModel& model) : model_(model) {
  const std::string graph = ReadGraph(model.graph), text = ReadTextGraph(model.text_graph);
  try {
    net_ = cv::dnn::readNetFromTensorflow(graph.data(), graph.size(), text.data(), text.size());
    net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  } catch (const cv::Exception& exception) {
    throw Error(model.graph,
                "OpenCV cannot load this network with its text graph: " + ReasonOf(exception));
  }
  const cv::Size trial = model.input.empty() ? cv::Size(320, 256) : model.input;
  const cv::Mat grey(trial, CV_8UC3, cv::Scalar::all(128));
  Detect(grey, FitMaskRcnnInput(trial, {.fixed = trial}));
  class_count_ = outputs_.masks.size[1];
}

Letterbox TensorflowMaskRcnn::Fit(cv::Size image) const {
  return FitMaskRcnnInput(image, {.fixed = model_.input, .most = {1365, 1365}});
}

std::vector<MaskRcnnDetection> TensorflowMaskRcnn::Detect(const cv::Mat& image,
                                                          const Letterbox& letterbox) {
  const cv::Mat blob = MakeMaskRcnnBlob(letterbox, image, {});  // RGB, 0 to 255
  const int shape[] = {1, 3, letterbox.input.height, letterbox.input.width};
  std::vector<cv::Mat> outputs;
  try {
    net_.setInput(blob.reshape(1, 4, shape));
    net_.forward(outputs, kOutputNames);
  } catch (const cv::Exception& exception) {
    throw Error(model_.graph,
                fmt::format("OpenCV cannot run this network at {} x {} px: {}",
                            letterbox.input.width, letterbox.input.height, ReasonOf(exception)));
  }
  outputs_ = {outputs[0], outputs[1]};
  try {
    return ReadTensorflowDetections(outputs_, letterbox.input);
  } catch (const Error& error) {
    throw Error(model_.graph, error.what());
  }
}

ClassMap TensorflowMaskRcnn::MapToCoco() const {
  if (class_count_ == kCoco91Classes) return MakeCoco91ClassMap();
  if (class_count_ == kCocoClasses) return MakeContiguousClassMap(kCocoClasses);
  throw Error(model_.graph, fmt::format("tells {} classes apart, which are not COCO's; name them "
                                        "in perception.class_names_file",
                                        class_count_));
}

ClassMap TensorflowMaskRcnn::MapToNames(int class_count) const {
  if (class_count != class_count_) {
    throw Error(model_.graph, fmt::format("the network tells {} classes apart but {} have a name",
                                          class_count_, class_count));
  }
  return MakeContiguousClassMap(class_count);
}

}  // namespace ofm
