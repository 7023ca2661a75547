#include "ofm/perception/mask_upsampling.h"

#include <gtest/gtest.h>

#include <limits>

#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

/// An object 1 m away before a wall 3 m away; its edges do not lie on those of the 4 × 4 px cells.
class UpsampleMaskTest : public testing::Test {
 protected:
  UpsampleMaskTest() {
    depth_m_ = cv::Mat(72, 96, CV_32FC1, cv::Scalar(3));
    depth_m_(object_) = 1;
    cell_depth_m_ = cells_.SampleNearest(depth_m_);
    moving_ = cell_depth_m_ < 2;
  }
  cv::Mat Upsample() const { return UpsampleMask(cells_, moving_, cell_depth_m_, depth_m_); }
  /// Pixels whose mask is not that of the object.
  int CountWrong(const cv::Mat& mask) const {
    cv::Mat truth = cv::Mat::zeros(mask.size(), CV_8UC1);
    truth(object_) = 255;
    return cv::countNonZero(mask != truth);
  }

  const cv::Rect object_{21, 18, 37, 30};
  IdealLattice cells_{MakeSimCamera(96, 72), 4};
  cv::Mat depth_m_, cell_depth_m_, moving_;
};

TEST_F(UpsampleMaskTest, MaskEndsWhereTheObjectsDepthEnds) {
  EXPECT_EQ(CountWrong(Upsample()), 0);
  EXPECT_GT(CountWrong(cells_.ToImage(moving_)), 50) << "cells alone are coarser";
}

TEST_F(UpsampleMaskTest, PixelsWithoutDepthFollowTheirOwnCell) {
  depth_m_.setTo(0);
  EXPECT_EQ(cv::norm(Upsample(), cells_.ToImage(moving_), cv::NORM_INF), 0);
  depth_m_.setTo(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(cv::norm(Upsample(), cells_.ToImage(moving_), cv::NORM_INF), 0);
}

TEST_F(UpsampleMaskTest, DepthIsNotAskedWhereCellsAgree) {
  moving_.setTo(255);
  EXPECT_EQ(cv::countNonZero(Upsample()), 96 * 72) << "the wall moves too";
  moving_.setTo(0);
  EXPECT_EQ(cv::countNonZero(Upsample()), 0);
}

/// Two surfaces that moved apart from one another: each pixel goes with the cell of its own depth.
TEST_F(UpsampleMaskTest, PixelFollowsTheDepthMostLikeItsOwn) {
  depth_m_(object_) = 2.8F;
  cell_depth_m_ = cells_.SampleNearest(depth_m_);
  moving_ = cell_depth_m_ < 2.9;
  EXPECT_EQ(CountWrong(Upsample()), 0);
}

TEST_F(UpsampleMaskTest, CellsWithoutDepthAreNotFollowed) {
  cell_depth_m_.setTo(0);
  EXPECT_EQ(cv::norm(Upsample(), cells_.ToImage(moving_), cv::NORM_INF), 0);
}

/// More than fit into one pass, and overlapping.
TEST_F(UpsampleMaskTest, ManyAtOnceAreWhatEachIsAlone) {
  std::vector<cv::Mat> masks;
  for (int i = 0; i < 70; ++i) {
    masks.push_back(moving_.clone());
    masks.back().colRange(0, i % moving_.cols) = 0;
  }
  const std::vector<cv::Mat> upsampled = UpsampleMasks(cells_, masks, cell_depth_m_, depth_m_);
  ASSERT_EQ(upsampled.size(), masks.size());
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const cv::Mat alone = UpsampleMask(cells_, masks[i], cell_depth_m_, depth_m_);
    EXPECT_EQ(cv::norm(upsampled[i], alone, cv::NORM_INF), 0) << i;
  }
  EXPECT_GT(cv::countNonZero(upsampled[9]), cv::countNonZero(upsampled[10]));
  EXPECT_TRUE(UpsampleMasks(cells_, {}, cell_depth_m_, depth_m_).empty());
}

TEST_F(UpsampleMaskTest, WorksWithALens) {
  PinholeCamera camera = MakeSimCamera(96, 72);
  camera.k1 = 0.26;
  camera.k2 = -0.95;
  const IdealLattice cells(camera, 4);
  cell_depth_m_ = cells.SampleNearest(depth_m_);
  moving_ = (cell_depth_m_ < 2) & (cell_depth_m_ > 0);
  EXPECT_LE(CountWrong(UpsampleMask(cells, moving_, cell_depth_m_, depth_m_)), 2);
}

}  // namespace
}  // namespace ofm
