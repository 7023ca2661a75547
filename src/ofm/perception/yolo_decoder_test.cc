#include "ofm/perception/yolo_decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>

#include "ofm/io/test_folder.h"
#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int kClasses = 3, kMasks = 3, kCells = 84;
constexpr int kRows = 4 + kClasses + kMasks;

struct Cell {
  float x, y, width, height;  // [input px]
  int class_index = 0;
  float score = 0.9F;
  float coefficients[kMasks] = {1, 0, 0};
};

/// Tensors of a network with an input of 64 x 64 px. Prototype 0 is 10 everywhere, prototype 1 is
/// 10 in the left half (cells 0 to 7) and -10 in the right, prototype 2 likewise above and below.
class Tensors {
 public:
  Tensors() {
    const int cell_shape[] = {1, kRows, kCells}, prototype_shape[] = {1, kMasks, 16, 16};
    cells_ = cv::Mat(3, cell_shape, CV_32F, cv::Scalar(0));
    prototypes_ = cv::Mat(4, prototype_shape, CV_32F, cv::Scalar(10));
    Prototype(1) = -10;
    Prototype(1)(cv::Rect(0, 0, 8, 16)) = 10;
    Prototype(2) = -10;
    Prototype(2)(cv::Rect(0, 0, 16, 8)) = 10;
  }

  cv::Mat Prototype(int index) { return cv::Mat(16, 16, CV_32F, prototypes_.ptr<float>(0, index)); }

  float& At(int row, int cell) { return cells_.at<float>(0, row, cell); }

  Tensors& Put(int index, const Cell& cell) {
    At(0, index) = cell.x, At(1, index) = cell.y;
    At(2, index) = cell.width, At(3, index) = cell.height;
    At(4 + cell.class_index, index) = cell.score;
    for (int m = 0; m < kMasks; ++m) At(4 + kClasses + m, index) = cell.coefficients[m];
    return *this;
  }

  std::vector<Instance> Decode(cv::Size image, const YoloDecoderOptions& options = {}) const {
    return DecodeYolo(SelectYoloOutputs({cells_, prototypes_}, kClasses),
                      MakeLetterbox(image, {64, 64}), options);
  }

  cv::Mat cells_, prototypes_;
};

cv::Mat Filled(cv::Size size, const cv::Rect& rectangle) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  mask(rectangle).setTo(255);
  return mask;
}

void ExpectSame(const cv::Mat& a, const cv::Mat& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(cv::countNonZero(a != b), 0);
}

TEST(YoloDecoder, OutputsAreToldApartByRankInEitherOrder) {
  const Tensors tensors;
  const auto a = SelectYoloOutputs({tensors.cells_, tensors.prototypes_}, kClasses);
  const auto b = SelectYoloOutputs({tensors.prototypes_, tensors.cells_}, kClasses);
  EXPECT_EQ(a.cells.data, b.cells.data);
  EXPECT_EQ(a.cells.size(), cv::Size(kCells, kRows));
  EXPECT_EQ(b.prototypes.size(), cv::Size(256, kMasks));
  EXPECT_EQ(b.prototype_size, cv::Size(16, 16));
}

/// The same cells as YOLOv5 gives them: one a row, objectness 0.5 before the classes.
TEST(YoloDecoder, Version5IsReadWithItsObjectness) {
  Tensors tensors;
  tensors.Put(7, {32, 32, 16, 16, 2, 0.8F}).Put(40, {10, 10, 8, 8, 0, 0.6F, {0, 1, 0}});
  const int shape[] = {1, kCells, kRows + 1};
  cv::Mat rows(3, shape, CV_32F, cv::Scalar(0));
  for (int cell = 0; cell < kCells; ++cell) {
    for (int row = 0; row < kRows; ++row) {
      rows.at<float>(0, cell, row < 4 ? row : row + 1) = tensors.At(row, cell);
    }
    rows.at<float>(0, cell, 4) = 0.5F;
  }
  const YoloOutputs outputs = SelectYoloOutputs({tensors.prototypes_, rows}, kClasses);
  ASSERT_EQ(outputs.cells.size(), cv::Size(kCells, kRows));
  const YoloOutputs expected = SelectYoloOutputs({tensors.cells_, tensors.prototypes_}, kClasses);
  for (int row = 0; row < kRows; ++row) {
    const double factor = row >= 4 && row < 4 + kClasses ? 0.5 : 1;
    EXPECT_LT(cv::norm(outputs.cells.row(row), expected.cells.row(row) * factor), 1e-6) << row;
  }
  EXPECT_THROW(SelectYoloOutputs({tensors.prototypes_, rows}, kClasses + 1), Error);
}

TEST(YoloDecoder, OtherOutputsAreRefusedWithTheirShapes) {
  const Tensors tensors;
  const auto error = [](const std::vector<cv::Mat>& outputs, int classes = kClasses) {
    return ErrorOf([&] { SelectYoloOutputs(outputs, classes); });
  };
  EXPECT_THAT(error({tensors.cells_}), HasSubstr("(1x10x84)"));
  EXPECT_THAT(error({}), HasSubstr("not those of a YOLO segmentation network"));
  EXPECT_THAT(error({tensors.cells_, tensors.cells_}), HasSubstr("(1x10x84, 1x10x84)"));
  EXPECT_THAT(error({tensors.cells_, cv::Mat::zeros(4, 4, CV_32F)}), HasSubstr("(1x10x84, 4x4)"));
  EXPECT_THAT(error({tensors.cells_, tensors.prototypes_}, 80),
              HasSubstr("tells 3 classes apart but 80 have a name"));
}

TEST(YoloDecoder, NothingOverTheThresholdIsNoInstance) {
  Tensors tensors;
  EXPECT_THAT(tensors.Decode({64, 64}), IsEmpty());
  tensors.Put(5, {32, 32, 16, 16, 1, 0.24F});
  EXPECT_THAT(tensors.Decode({64, 64}), IsEmpty());
  EXPECT_THAT(tensors.Decode({64, 64}, {.score_threshold = 0.2}), SizeIs(1));
}

TEST(YoloDecoder, CellBecomesAnInstanceOfItsLikeliestClass) {
  Tensors tensors;
  tensors.Put(83, {30, 20, 20, 12, 2, 0.8F});
  tensors.At(4, 83) = 0.3F;  // another class is less likely
  const auto instances = tensors.Decode({64, 64});
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(instances[0].class_id, ClassId(2));
  EXPECT_FLOAT_EQ(instances[0].score, 0.8F);
  EXPECT_EQ(instances[0].box, cv::Rect(20, 14, 20, 12));
  ExpectSame(instances[0].mask, Filled({64, 64}, {20, 14, 20, 12}));
}

TEST(YoloDecoder, BoxHoldsThePixelsWhoseCentresItHolds) {
  Tensors tensors;
  tensors.Put(0, {20, 20, 5.2F, 4.8F});  // x 17.4 to 22.6, y 17.6 to 22.4
  const auto instances = tensors.Decode({64, 64});
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_EQ(instances[0].box, cv::Rect(17, 18, 6, 4));
}

/// Prototype cells are 4 px wide; the sign changes between cells 7 and 8, half way between their
/// centres at 30 and 34: at 32 px of the input.
TEST(YoloDecoder, MaskEdgeIsWhereThePrototypesCross) {
  Tensors tensors;
  tensors.Put(0, {32, 32, 64, 64, 0, 0.9F, {0, 1, 0}});
  ExpectSame(tensors.Decode({64, 64}).at(0).mask, Filled({64, 64}, {0, 0, 32, 64}));
  tensors.Put(0, {32, 32, 64, 64, 0, 0.9F, {0, 0, 1}});
  ExpectSame(tensors.Decode({64, 64}).at(0).mask, Filled({64, 64}, {0, 0, 64, 32}));
}

/// 128 x 96 px become 64 x 48 in the middle of the input, 8 px from its top: the edge at 32 px is
/// at 64 px in x and at (32 - 8) * 2 = 48 px in y.
TEST(YoloDecoder, MaskEdgeIsRightThroughTheLetterbox) {
  Tensors tensors;
  tensors.Put(0, {32, 32, 64, 64, 0, 0.9F, {0, 1, 0}});
  const auto instances = tensors.Decode({128, 96});
  EXPECT_EQ(instances.at(0).box, cv::Rect(0, 0, 128, 96));
  ExpectSame(instances.at(0).mask, Filled({128, 96}, {0, 0, 64, 96}));
  tensors.Put(0, {32, 32, 64, 64, 0, 0.9F, {0, 0, 1}});
  ExpectSame(tensors.Decode({128, 96}).at(0).mask, Filled({128, 96}, {0, 0, 128, 48}));
}

/// With 10 · 1 against 10 · -0.1 the probabilities are nearly 1 and .27: one half is crossed
/// at (1 - .5) / (1 - .27) = .684 of the way from 30 to 34 px, at 32.74 px of the input. The image
/// is four times as large: 130.9 px, so that the pixel 130 with its centre at 130.5 is the last.
TEST(YoloDecoder, MaskIsInterpolatedBetweenPrototypeCells) {
  Tensors tensors;
  tensors.Prototype(1) = -1;
  tensors.Prototype(1)(cv::Rect(0, 0, 8, 16)) = 10;
  tensors.Put(0, {32, 32, 64, 64, 0, 0.9F, {0, 1, 0}});
  ExpectSame(tensors.Decode({256, 256}).at(0).mask, Filled({256, 256}, {0, 0, 131, 256}));
}

TEST(YoloDecoder, MaskIsTheWeightedSumOfPrototypes) {
  Tensors tensors;
  tensors.Put(0,
              {32, 32, 64, 64, 0, 0.9F, {0.5F, -1, 0}});  // 5 - 10 on the left, 5 + 10 on the right
  cv::Mat on_the_right = tensors.Decode({64, 64}).at(0).mask;
  EXPECT_EQ(on_the_right.at<std::uint8_t>(10, 10), 0);
  EXPECT_EQ(on_the_right.at<std::uint8_t>(10, 50), 255);
  tensors.Put(0,
              {32, 32, 64, 64, 0, 0.9F, {-0.5F, 1, 1}});  // upper left 15, lower right -25, else -5
  ExpectSame(tensors.Decode({64, 64}).at(0).mask(cv::Rect(0, 0, 28, 28)),
             cv::Mat(28, 28, CV_8UC1, cv::Scalar(255)));
  EXPECT_EQ(tensors.Decode({64, 64}).at(0).mask.at<std::uint8_t>(10, 50), 0);
}

TEST(YoloDecoder, WeakerBoxOfTheSameClassIsSuppressed) {
  Tensors tensors;
  tensors.Put(0, {30, 30, 20, 20, 1, 0.6F}).Put(1, {31, 30, 20, 20, 1, 0.8F});
  const auto instances = tensors.Decode({64, 64});
  ASSERT_THAT(instances, SizeIs(1));
  EXPECT_FLOAT_EQ(instances[0].score, 0.8F);
}

/// 20 x 20 boxes 5 px apart: IoU = 300 / 500 = .6.
TEST(YoloDecoder, OverlapUnderTheThresholdIsKept) {
  Tensors tensors;
  tensors.Put(0, {25, 30, 20, 20, 1, 0.6F}).Put(1, {30, 30, 20, 20, 1, 0.8F});
  EXPECT_THAT(tensors.Decode({64, 64}, {.nms_threshold = 0.61}), SizeIs(2));
  EXPECT_THAT(tensors.Decode({64, 64}, {.nms_threshold = 0.59}), SizeIs(1));
}

TEST(YoloDecoder, ClassesDoNotSuppressOneAnother) {
  Tensors tensors;
  tensors.Put(0, {30, 30, 20, 20, 1, 0.6F}).Put(1, {30, 30, 20, 20, 2, 0.8F});
  EXPECT_THAT(tensors.Decode({64, 64}), SizeIs(2));
}

TEST(YoloDecoder, MostConfidentComeFirstAndAreKept) {
  Tensors tensors;
  tensors.Put(0, {10, 10, 8, 8, 0, 0.5F}).Put(1, {40, 10, 8, 8, 0, 0.7F});
  tensors.Put(2, {10, 40, 8, 8, 0, 0.6F});
  const auto instances = tensors.Decode({64, 64}, {.max_instances = 2});
  ASSERT_THAT(instances, SizeIs(2));
  EXPECT_FLOAT_EQ(instances[0].score, 0.7F);
  EXPECT_FLOAT_EQ(instances[1].score, 0.6F);
  EXPECT_EQ(instances[0].id, InstanceId(0));
  EXPECT_EQ(instances[1].id, InstanceId(1));
}

TEST(YoloDecoder, BoxBeyondTheImageIsCut) {
  Tensors tensors;
  tensors.Put(0, {60, 4, 400, 20});
  EXPECT_EQ(tensors.Decode({64, 64}).at(0).box, cv::Rect(0, 0, 64, 14));
}

TEST(YoloDecoder, BoxInTheLetterboxBorderIsDropped) {
  Tensors tensors;
  tensors.Put(0, {32, 3, 20, 6});
  EXPECT_THAT(tensors.Decode({64, 64}), SizeIs(1));
  EXPECT_THAT(tensors.Decode({128, 96}), IsEmpty());
}

TEST(YoloDecoder, EmptyMaskIsDropped) {
  Tensors tensors;
  tensors.Put(0, {32, 32, 20, 20, 0, 0.9F, {-1, 0, 0}});
  EXPECT_THAT(tensors.Decode({64, 64}), IsEmpty());
}

TEST(YoloDecoder, NumbersThatAreNotFiniteAreDropped) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Tensors tensors;
  tensors.Put(0, {nan, 32, 20, 20}).Put(1, {32, 32, infinity, 20}).Put(2, {32, 32, 20, -5});
  tensors.Put(3, {32, 32, 20, 20, 0, nan}).Put(4, {32, 32, 20, 20, 0, 0.9F, {nan, 0, 0}});
  EXPECT_THAT(tensors.Decode({64, 64}), IsEmpty());
}

}  // namespace
}  // namespace ofm
