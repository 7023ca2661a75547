#include "ofm/perception/cell_origins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ofm {
namespace {

const cv::Size kSize(30, 20);

/// A wall 3 m away, with an object 1 m away at `object`; everything has come by `flow`.
LatticeStep MakeStep(const cv::Rect& object, cv::Vec2f flow = {0, 0}) {
  LatticeStep step;
  step.frame.depth_m = cv::Mat(kSize, CV_32FC1, cv::Scalar(3));
  step.frame.depth_m(object) = 1;
  step.flow = cv::Mat(kSize, CV_32FC2, cv::Scalar(flow[0], flow[1]));
  return step;
}

cv::Vec2f At(const cv::Mat& origins, int x, int y) { return origins.at<cv::Vec2f>(y, x); }

void ExpectNear(const cv::Vec2f& a, const cv::Vec2f& b) { EXPECT_LT(cv::norm(a - b), 1e-4) << a; }

TEST(CellOrigins, WithoutMotionCellsAreWhereTheyWere) {
  const LatticeStep still = MakeStep({10, 5, 8, 8});
  const cv::Mat origins = CarryOrigins(OwnOrigins(kSize), still.frame.depth_m, still);
  EXPECT_EQ(cv::norm(origins, OwnOrigins(kSize), cv::NORM_INF), 0);
}

TEST(CellOrigins, MotionsOfPartsOfACellAddUp) {
  cv::Mat origins = OwnOrigins(kSize);
  const LatticeStep step = MakeStep({}, {0.3F, -0.2F});
  for (int i = 0; i < 10; ++i) origins = CarryOrigins(origins, step.frame.depth_m, step);
  ExpectNear(At(origins, 12, 9), {12 + 3, 9 - 2});
}

/// The object moves 3 cells to the right. Flow has bled over its edge by two cells on each side.
TEST(CellOrigins, FlowThatBledOverAnEdgeIsMendedByDepth) {
  const LatticeStep last = MakeStep({8, 5, 8, 8});
  LatticeStep now = MakeStep({11, 5, 8, 8});
  now.flow(cv::Rect(9, 3, 12, 12)) = cv::Scalar(-3, 0);
  const cv::Mat origins = CarryOrigins(OwnOrigins(kSize), last.frame.depth_m, now);
  ExpectNear(At(origins, 11, 8), {8, 8});
  ExpectNear(At(origins, 18, 8), {15, 8});
  ExpectNear(At(origins, 20, 8), {17, 8});
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      const cv::Vec2f from = At(origins, x, y);
      if (from[0] == kNoOrigin) continue;
      const cv::Point cell(cvRound(from[0]), cvRound(from[1]));
      if (!cv::Rect({}, kSize).contains(cell)) continue;
      const float before_m = last.frame.depth_m.at<float>(cell);
      EXPECT_EQ(before_m, now.frame.depth_m.at<float>(y, x)) << x << " " << y;
    }
  }
}

/// The object's flow was not seen on its rim: that goes with the rest of it.
TEST(CellOrigins, CellsThatFlowTakesToAnotherSurfaceGoWithTheirOwn) {
  const LatticeStep last = MakeStep({2, 5, 6, 8});
  LatticeStep now = MakeStep({12, 5, 6, 8});
  now.flow(cv::Rect(13, 6, 4, 6)) = cv::Scalar(-10, 0);
  const cv::Mat origins = CarryOrigins(OwnOrigins(kSize), last.frame.depth_m, now);
  ExpectNear(At(origins, 12, 8), {2, 8});
  ExpectNear(At(origins, 17, 8), {7, 8});
  ExpectNear(At(origins, 14, 12), {4, 12});
}

TEST(CellOrigins, WhatComesFromNowhereHasNone) {
  LatticeStep now = MakeStep({10, 5, 8, 8});  // was not there before
  const LatticeStep last = MakeStep({});
  const cv::Mat origins = CarryOrigins(OwnOrigins(kSize), last.frame.depth_m, now);
  EXPECT_EQ(At(origins, 14, 9)[0], kNoOrigin);
  ExpectNear(At(origins, 3, 3), {3, 3});
  const cv::Mat later = CarryOrigins(origins, now.frame.depth_m, now);
  EXPECT_EQ(At(later, 14, 9)[0], kNoOrigin) << "nor later";
}

TEST(CellOrigins, WhatComesIntoViewCameFromBeyond) {
  const LatticeStep now = MakeStep({}, {-1.5F, 0});
  const cv::Mat origins = CarryOrigins(OwnOrigins(kSize), now.frame.depth_m, now);
  ExpectNear(At(origins, 5, 5), {3.5F, 5});
  EXPECT_LT(At(origins, 0, 5)[0], 0);
  EXPECT_LT(At(origins, 1, 5)[0], 0);
}

TEST(CellOrigins, WithoutDepthFlowIsFollowed) {
  LatticeStep now = MakeStep({10, 5, 8, 8}, {1, 0});
  const cv::Mat nothing(kSize, CV_32FC1, cv::Scalar(0));
  ExpectNear(At(CarryOrigins(OwnOrigins(kSize), nothing, now), 12, 8), {13, 8});
  now.frame.depth_m.setTo(0);
  const LatticeStep last = MakeStep({});
  ExpectNear(At(CarryOrigins(OwnOrigins(kSize), last.frame.depth_m, now), 12, 8), {13, 8});
}

TEST(CellOrigins, ImagesOfDifferentSizesAreAProgrammersError) {
  const LatticeStep now = MakeStep({});
  EXPECT_THROW(CarryOrigins(OwnOrigins({20, 20}), now.frame.depth_m, now), std::logic_error);
  EXPECT_THROW(CarryOrigins(OwnOrigins(kSize), now.frame.depth_m, {now.frame, {}}),
               std::logic_error);
}

}  // namespace
}  // namespace ofm
