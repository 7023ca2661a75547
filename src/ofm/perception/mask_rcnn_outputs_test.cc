#include "ofm/perception/mask_rcnn_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Rows of TensorFlow's detections, and masks in which class c of row n is n + c / 10 everywhere.
TensorflowMaskRcnnOutputs MakeTensorflow(const std::vector<std::array<float, 7>>& rows,
                                         int classes = 3) {
  const int count = static_cast<int>(rows.size());
  const int detection_shape[] = {1, 1, count, 7}, mask_shape[] = {count, classes, 2, 3};
  TensorflowMaskRcnnOutputs outputs{cv::Mat(4, detection_shape, CV_32F),
                                    cv::Mat(4, mask_shape, CV_32F)};
  for (int n = 0; n < count; ++n) {
    std::copy(rows[n].begin(), rows[n].end(), outputs.detections.ptr<float>() + 7 * n);
    for (int c = 0; c < classes; ++c) {
      std::fill_n(outputs.masks.ptr<float>(n, c), 6, n + c / 10.0F);
    }
  }
  return outputs;
}

TEST(TensorflowOutputs, SharesOfTheInputBecomePixels) {
  const auto detections =
      ReadTensorflowDetections(MakeTensorflow({{0, 2, 0.5F, 0.25F, 0.5F, 0.75F, 1}}), {80, 40});
  ASSERT_THAT(detections, SizeIs(1));
  EXPECT_EQ(detections[0].box, cv::Rect2d(20, 20, 40, 20));
  EXPECT_EQ(detections[0].label, 3);
  EXPECT_EQ(detections[0].score, 0.5F);
  EXPECT_EQ(detections[0].extent, MaskExtent::kBox);
}

TEST(TensorflowOutputs, MaskIsThatOfTheRowAndItsClass) {
  const auto outputs = MakeTensorflow({{0, 0, 0.9F, 0, 0, 1, 1}, {0, 2, 0.5F, 0, 0, 1, 1}});
  const auto detections = ReadTensorflowDetections(outputs, {80, 40});  // headers onto `outputs`
  ASSERT_THAT(detections, SizeIs(2));
  EXPECT_EQ(detections[0].mask.size(), cv::Size(3, 2));
  EXPECT_FLOAT_EQ(detections[0].mask.at<float>(1, 2), 0);
  EXPECT_FLOAT_EQ(detections[1].mask.at<float>(0, 0), 1.2F);
}

TEST(TensorflowOutputs, FillingRowsAndUnknownClassesAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(ReadTensorflowDetections(MakeTensorflow({{0, 0, 0, 0, 0, 0, 0},
                                                       {0, 3, 0.9F, 0, 0, 1, 1},
                                                       {0, -1, 0.9F, 0, 0, 1, 1},
                                                       {0, nan, 0.9F, 0, 0, 1, 1},
                                                       {0, 1, nan, 0, 0, 1, 1}}),
                                       {80, 40}),
              IsEmpty());
}

TEST(TensorflowOutputs, OtherShapesAreToldInOneLine) {
  TensorflowMaskRcnnOutputs outputs = MakeTensorflow({{0, 0, 0.9F, 0, 0, 1, 1}});
  EXPECT_EQ(ErrorOf([&] { CheckTensorflowOutputs(outputs); }), "");
  std::swap(outputs.detections, outputs.masks);
  EXPECT_THAT(ErrorOf([&] { CheckTensorflowOutputs(outputs); }),
              AllOf(HasSubstr("1x3x2x3, 1x1x1x7"), HasSubstr("not those of a Mask R-CNN")));
  EXPECT_NE(ErrorOf([] { CheckTensorflowOutputs({}); }), "");
}

/// Outputs of an ONNX export with its numbers.
class OnnxOutputs {
 public:
  explicit OnnxOutputs(int count, cv::Size mask = {28, 28}) {
    for (int i = 0; i < count; ++i) {
      for (const float edge : {1.0F * i, 2.0F, 10.0F, 20.0F}) boxes.push_back(edge);
      labels.push_back(i + 1);
      scores.push_back(1.0F / static_cast<float>(i + 1));
      for (int p = 0; p < mask.area(); ++p) masks.push_back(static_cast<float>(i) / 10);
    }
    tensors = {Real("6568", {count, 4}, boxes), Whole("6570", {count}, labels),
               Real("6572", {count}, scores),
               Real("6887", {count, 1, mask.height, mask.width}, masks)};
  }

  static OnnxTensor Real(const char* name, std::vector<std::int64_t> shape,
                         std::span<const float> values) {
    return {OnnxTensor::Type::kReal, name, std::move(shape), values, {}};
  }
  static OnnxTensor Whole(const char* name, std::vector<std::int64_t> shape,
                          std::span<const std::int64_t> values) {
    return {OnnxTensor::Type::kWhole, name, std::move(shape), {}, values};
  }

  std::vector<float> boxes, scores, masks;
  std::vector<std::int64_t> labels;
  std::vector<OnnxTensor> tensors;
};

TEST(OnnxOutputs, AreToldApartInAnyOrder) {
  const OnnxOutputs outputs(2);
  std::vector<OnnxTensor> tensors = outputs.tensors;
  for (int turn = 0; turn < 4; ++turn) {
    std::rotate(tensors.begin(), tensors.begin() + 1, tensors.end());
    const OnnxMaskRcnnOutputs selected = SelectOnnxOutputs(tensors);
    EXPECT_EQ(selected.boxes.name, "6568");
    EXPECT_EQ(selected.labels.name, "6570");
    EXPECT_EQ(selected.scores.name, "6572");
    EXPECT_EQ(selected.masks.name, "6887");
  }
}

TEST(OnnxOutputs, NoDetectionIsFine) {
  const OnnxOutputs outputs(0);
  const OnnxMaskRcnnOutputs selected = SelectOnnxOutputs(outputs.tensors);
  EXPECT_THAT(ReadOnnxDetections(selected, MaskRcnnExport::kModelZoo), IsEmpty());
  EXPECT_EQ(FindExporter(selected, {320, 256}), MaskRcnnExport::kModelZoo);
}

TEST(OnnxOutputs, SizeOfTheMasksTellsTheExporter) {
  const OnnxOutputs outputs(1, {32, 24});
  const OnnxMaskRcnnOutputs selected = SelectOnnxOutputs(outputs.tensors);
  EXPECT_EQ(FindExporter(selected, {32, 24}), MaskRcnnExport::kTorchvision);
  EXPECT_EQ(FindExporter(selected, {24, 32}), MaskRcnnExport::kModelZoo);
}

TEST(OnnxOutputs, ZooBoxesNameTheirLastPixelAndTheirMasksAreTheBoxes) {
  const OnnxOutputs outputs(2);
  const auto detections =
      ReadOnnxDetections(SelectOnnxOutputs(outputs.tensors), MaskRcnnExport::kModelZoo);
  ASSERT_THAT(detections, SizeIs(2));
  EXPECT_EQ(detections[1].box, cv::Rect2d(1, 2, 10, 19));
  EXPECT_EQ(detections[1].label, 2);
  EXPECT_FLOAT_EQ(detections[1].score, 0.5F);
  EXPECT_EQ(detections[1].extent, MaskExtent::kBox);
  EXPECT_EQ(detections[1].mask.size(), cv::Size(28, 28));
  EXPECT_FLOAT_EQ(detections[1].mask.at<float>(0, 0), 0.1F);
  EXPECT_FLOAT_EQ(detections[0].mask.at<float>(27, 27), 0);
}

TEST(OnnxOutputs, TorchvisionBoxesEndWhereTheySayAndTheirMasksAreTheInputs) {
  const OnnxOutputs outputs(2, {32, 24});
  const auto detections =
      ReadOnnxDetections(SelectOnnxOutputs(outputs.tensors), MaskRcnnExport::kTorchvision);
  ASSERT_THAT(detections, SizeIs(2));
  EXPECT_EQ(detections[1].box, cv::Rect2d(1, 2, 9, 18));
  EXPECT_EQ(detections[1].extent, MaskExtent::kInput);
  EXPECT_EQ(detections[1].mask.size(), cv::Size(32, 24));
}

TEST(OnnxOutputs, MasksMayLackTheirChannel) {
  OnnxOutputs outputs(2);
  outputs.tensors[3].shape = {2, 28, 28};
  const auto detections =
      ReadOnnxDetections(SelectOnnxOutputs(outputs.tensors), MaskRcnnExport::kModelZoo);
  ASSERT_THAT(detections, SizeIs(2));
  EXPECT_EQ(detections[1].mask.size(), cv::Size(28, 28));
}

TEST(OnnxOutputs, WhatIsMissingOrDoesNotFitIsToldInOneLine) {
  const OnnxOutputs whole(2), other(3);
  for (std::size_t i = 0; i < whole.tensors.size(); ++i) {
    std::vector<OnnxTensor> tensors = whole.tensors;
    tensors.erase(tensors.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_THAT(ErrorOf([&] { SelectOnnxOutputs(tensors); }),
                HasSubstr("not those of a Mask R-CNN"))
        << i;
    tensors = whole.tensors;
    tensors[i] = other.tensors[i];
    EXPECT_THAT(ErrorOf([&] { SelectOnnxOutputs(tensors); }), HasSubstr("6570 ")) << i;
  }
}

TEST(OnnxOutputs, HugeLabelHasNoClass) {
  OnnxOutputs outputs(1);
  outputs.labels[0] = std::numeric_limits<std::int64_t>::max();
  const auto detections =
      ReadOnnxDetections(SelectOnnxOutputs(outputs.tensors), MaskRcnnExport::kModelZoo);
  ASSERT_THAT(detections, SizeIs(1));
  EXPECT_FALSE(FindClassOfLabel(MakeContiguousClassMap(80), detections[0].label).valid());
}

}  // namespace
}  // namespace ofm
