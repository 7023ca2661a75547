#include "ofm/perception/yolo_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/dnn/dnn.hpp>

#include "ofm/base/error.h"
#include "ofm/perception/prototype_mask.h"

namespace ofm {
namespace {

constexpr int kBoxRows = 4;

std::string ShapesOf(const std::vector<cv::Mat>& outputs) {
  std::vector<std::string> shapes;
  for (const cv::Mat& output : outputs) {
    const std::vector<int> sizes(output.size.p, output.size.p + output.dims);
    shapes.push_back(fmt::format("{}", fmt::join(sizes, "x")));
  }
  return fmt::format("{}", fmt::join(shapes, ", "));
}

/// YOLOv5's cells, one a row with an objectness before the class probabilities, in the order of the
/// later versions: a class's probability is the product of both.
cv::Mat CellsFromVersion5(const cv::Mat& rows, int class_count) {
  const cv::Mat columns = rows.t();
  const cv::Mat objectness = columns.row(kBoxRows);
  cv::Mat cells(columns.rows - 1, columns.cols, CV_32FC1);
  columns.rowRange(0, kBoxRows).copyTo(cells.rowRange(0, kBoxRows));
  columns.rowRange(kBoxRows + 1, columns.rows).copyTo(cells.rowRange(kBoxRows, cells.rows));
  for (int c = 0; c < class_count; ++c) {
    cv::Mat probability = cells.row(kBoxRows + c);
    cv::multiply(probability, objectness, probability);
  }
  return cells;
}

/// Cells over the threshold, as lists of the same length.
struct Candidates {
  std::vector<int> cells;
  std::vector<std::uint32_t> classes;
  std::vector<float> scores;
  std::vector<cv::Rect2d> boxes;  // [input px]
};

/// Empty where a number is not finite or the box has no area.
cv::Rect2d BoxOf(const cv::Mat& cells, int cell) {
  const double x = cells.at<float>(0, cell), y = cells.at<float>(1, cell);
  const double width = cells.at<float>(2, cell), height = cells.at<float>(3, cell);
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(width) || !std::isfinite(height)) {
    return {};
  }
  return {x - width / 2, y - height / 2, width, height};
}

Candidates FindCandidates(const cv::Mat& cells, int class_count, float score_threshold) {
  // Class by class, as the numbers lie in memory.
  std::vector<float> best(cells.cols, 0.0F);
  std::vector<std::uint32_t> best_class(cells.cols, 0);
  for (int c = 0; c < class_count; ++c) {
    const float* scores = cells.ptr<float>(kBoxRows + c);
    for (int i = 0; i < cells.cols; ++i) {
      const bool better = scores[i] > best[i];
      best[i] = better ? scores[i] : best[i];
      best_class[i] = better ? static_cast<std::uint32_t>(c) : best_class[i];
    }
  }
  Candidates candidates;
  for (int i = 0; i < cells.cols; ++i) {
    if (best[i] < score_threshold) continue;
    const cv::Rect2d box = BoxOf(cells, i);
    if (box.empty()) continue;
    candidates.cells.push_back(i);
    candidates.classes.push_back(best_class[i]);
    candidates.scores.push_back(std::min(best[i], 1.0F));
    candidates.boxes.push_back(box);
  }
  return candidates;
}

/// Indices of the candidates that survive, the most confident first.
std::vector<int> Suppress(const Candidates& candidates, cv::Size input,
                          const YoloDecoderOptions& options) {
  // Every class has a place of its own, far enough from the others that they never overlap.
  const double stride = 8.0 * std::max(input.width, input.height);
  std::vector<cv::Rect2d> boxes = candidates.boxes;
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].x += stride * candidates.classes[i];
  std::vector<int> kept;
  cv::dnn::NMSBoxes(boxes, candidates.scores, 0.0F, static_cast<float>(options.nms_threshold),
                    kept);
  if (kept.size() > static_cast<std::size_t>(options.max_instances)) {
    kept.resize(options.max_instances);
  }
  return kept;
}

}  // namespace

YoloOutputs SelectYoloOutputs(const std::vector<cv::Mat>& outputs, int class_count) {
  YoloOutputs selected;
  if (outputs.size() == 2 && outputs[0].dims + outputs[1].dims == 7) {
    const cv::Mat& cells = outputs[outputs[0].dims == 3 ? 0 : 1];
    const cv::Mat& prototypes = outputs[outputs[0].dims == 3 ? 1 : 0];
    const bool fits = prototypes.dims == 4 && cells.size[0] == 1 && prototypes.size[0] == 1 &&
                      cells.type() == CV_32F && prototypes.type() == CV_32F;
    if (fits) {
      selected.cells = cells.reshape(1, cells.size[1]);
      if (cells.size[2] == kBoxRows + 1 + class_count + prototypes.size[1] &&
          cells.size[1] != kBoxRows + class_count + prototypes.size[1]) {
        selected.cells = CellsFromVersion5(selected.cells, class_count);
      }
      selected.prototypes = prototypes.reshape(1, prototypes.size[1]);
      selected.prototype_size = cv::Size(prototypes.size[3], prototypes.size[2]);
    }
  }
  const int classes = selected.cells.rows - kBoxRows - selected.prototypes.rows;
  if (selected.cells.empty() || classes < 1) {
    throw Error(
        fmt::format("the outputs ({}) are not those of a YOLO segmentation network "
                    "(1 x 4+classes+masks x cells and 1 x masks x height x width)",
                    ShapesOf(outputs)));
  }
  if (classes != class_count) {
    throw Error(
        fmt::format("the network tells {} classes apart but {} have a name; "
                    "set perception.class_names_file",
                    classes, class_count));
  }
  return selected;
}

std::vector<Instance> DecodeYolo(const YoloOutputs& outputs, const Letterbox& letterbox,
                                 const YoloDecoderOptions& options) {
  const int class_count = outputs.cells.rows - kBoxRows - outputs.prototypes.rows;
  const Candidates candidates =
      FindCandidates(outputs.cells, class_count, static_cast<float>(options.score_threshold));
  std::vector<Instance> instances;
  for (const int i : Suppress(candidates, letterbox.input, options)) {
    Instance instance;
    instance.id = InstanceId(static_cast<std::uint32_t>(instances.size()));
    instance.class_id = ClassId(candidates.classes[i]);
    instance.score = candidates.scores[i];
    instance.box = ImagePixelsIn(candidates.boxes[i], letterbox);
    if (instance.box.empty()) continue;
    const cv::Mat coefficients =
        outputs.cells.col(candidates.cells[i]).rowRange(kBoxRows + class_count, outputs.cells.rows);
    instance.mask =
        PastePrototypeMask({outputs.prototypes, outputs.prototype_size, coefficients.clone()},
                           letterbox, instance.box);
    if (cv::countNonZero(instance.mask(instance.box)) == 0) continue;
    instances.push_back(std::move(instance));
  }
  return instances;
}

}  // namespace ofm
