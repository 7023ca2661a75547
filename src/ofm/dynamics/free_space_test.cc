#include "ofm/dynamics/free_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ofm/base/time.h"
#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const PinholeCamera kCamera = MakeSimCamera(40, 30);
const cv::Size kSize(40, 30);
const cv::Rect kBlock(15, 10, 10, 10);
const FreeSpaceOptions kOptions{.margin_m = 0.1,
                                .margin_per_metre = 0.02,
                                .log_odds = 1.5,
                                .static_log_odds = -0.25,
                                .interval_s = 0.1,
                                .memory_s = 1};

/// A wall, and before it a block unless its depth is that of the wall.
cv::Mat Depth(float wall_m, float block_m) {
  cv::Mat depth(kSize, CV_32FC1, cv::Scalar(wall_m));
  depth(kBlock) = block_m;
  return depth;
}

DepthView View(const cv::Mat& depth_m, const RigidTransform& camera_from_start = {}) {
  return MakeDepthView(0, camera_from_start, depth_m);
}

cv::Mat Evidence(const DepthView& current, const std::vector<DepthView>& earlier) {
  std::vector<const DepthView*> views;
  for (const DepthView& view : earlier) views.push_back(&view);
  return FreeSpaceEvidence(kCamera, current, views, kOptions);
}

/// Cells with exactly this value.
int Count(const cv::Mat& evidence, double value) {
  return cv::countNonZero(evidence == static_cast<float>(value));
}

TEST(FreeSpace, WhatStepsIntoSeenThroughSpaceMoves) {
  const cv::Mat evidence = Evidence(View(Depth(3, 1.5F)), {View(Depth(3, 3))});
  EXPECT_EQ(Count(evidence(kBlock), kOptions.log_odds), kBlock.area());
  EXPECT_EQ(Count(evidence, kOptions.log_odds), kBlock.area());
  EXPECT_EQ(Count(evidence, kOptions.static_log_odds), kSize.area() - kBlock.area());
}

TEST(FreeSpace, WhatWasHiddenSaysNothing) {
  const cv::Mat evidence = Evidence(View(Depth(3, 3)), {View(Depth(3, 1.5F))});
  EXPECT_EQ(cv::countNonZero(evidence(kBlock)), 0);
  EXPECT_EQ(Count(evidence, kOptions.static_log_odds), kSize.area() - kBlock.area());
}

TEST(FreeSpace, WhatWasOutOfViewSaysNothing) {
  const DepthView current = View(Depth(3, 1.5F));
  const cv::Mat wall = Depth(3, 3);
  EXPECT_EQ(cv::countNonZero(Evidence(current, {View(wall, {ExpSo3({0, 1.6, 0}), {0, 0, 0}})})), 0);
  EXPECT_EQ(cv::countNonZero(Evidence(current, {View(wall, {ExpSo3({0, M_PI, 0}), {0, 0, 0}})})), 0)
      << "behind the earlier camera";
  EXPECT_EQ(cv::countNonZero(Evidence(current, {})), 0) << "nothing was seen before";
}

TEST(FreeSpace, CellsWithoutDepthSayNothing) {
  const cv::Mat evidence = Evidence(View(Depth(0, 1.5F)), {View(Depth(3, 3))});
  EXPECT_EQ(Count(evidence, kOptions.log_odds), kBlock.area());
  EXPECT_EQ(cv::countNonZero(evidence), kBlock.area());
}

TEST(FreeSpace, NothingIsSeenThroughBesideWhatWasNotMeasured) {
  cv::Mat wall = Depth(3, 3);
  wall.at<float>(14, 19) = 0;
  const cv::Mat evidence = Evidence(View(Depth(3, 1.5F)), {View(wall)});
  EXPECT_EQ(cv::countNonZero(evidence(cv::Rect(18, 13, 3, 3))), 0);
  EXPECT_EQ(Count(evidence(kBlock), kOptions.log_odds), kBlock.area() - 9);
}

/// The margin at 1.5 m is 0.1 + 0.02 · 1.5 = 0.13 m.
TEST(FreeSpace, DepthWithinTheMarginIsTheSameSurface) {
  const DepthView wall = View(Depth(1.5F, 1.5F));
  EXPECT_EQ(Count(Evidence(View(Depth(1.5F, 1.4F)), {wall})(kBlock), kOptions.static_log_odds),
            kBlock.area());
  EXPECT_EQ(Count(Evidence(View(Depth(1.5F, 1.3F)), {wall})(kBlock), kOptions.log_odds),
            (kBlock.width) * kBlock.height);
}

TEST(FreeSpace, CameraMayHaveMovedAndTurned) {
  // A metre nearer and turned: the wall z = 3 m of the start is not parallel to the image any more.
  const RigidTransform motion(ExpSo3({0, 0.15, 0}), {0.1, 0, -0.5});
  cv::Mat wall(kSize, CV_32FC1), block;
  const Eigen::Vector3d normal = motion.RotationMatrix() * Eigen::Vector3d::UnitZ();
  const double distance = 3 + normal.dot(motion.translation());
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) {
      wall.at<float>(y, x) =
          static_cast<float>(distance / normal.dot(kCamera.UnprojectIdeal({x, y}, 1)));
    }
  }
  block = wall.clone();
  block(kBlock) = 1.2F;
  const DepthView start = View(Depth(3, 3));
  const cv::Mat at_rest = Evidence(View(wall, motion), {start});
  EXPECT_EQ(Count(at_rest, kOptions.log_odds), 0);
  EXPECT_GT(Count(at_rest, kOptions.static_log_odds), 0.6 * kSize.area());
  EXPECT_EQ(Count(Evidence(View(block, motion), {start})(kBlock), kOptions.log_odds),
            kBlock.area());
  EXPECT_GT(Count(Evidence(View(wall), {start}), kOptions.log_odds), 100)
      << "with a wrong pose the wall would move";
}

TEST(FreeSpace, OneViewThatSawThroughOutweighsThoseThatDidNot) {
  const DepthView free = View(Depth(3, 3)), occupied = View(Depth(3, 1.5F));
  const cv::Mat evidence =
      Evidence(View(Depth(3, 1.5F)), {occupied, occupied, free, occupied, occupied});
  EXPECT_EQ(Count(evidence(kBlock), kOptions.log_odds), kBlock.area());
  EXPECT_EQ(Count(evidence, 5 * kOptions.static_log_odds), kSize.area() - kBlock.area());
}

TEST(DepthView, LeastDepthIsThatOfTheCellsAround) {
  const DepthView view = View(Depth(3, 2));
  EXPECT_EQ(Count(view.least_depth_m, 2), 12 * 12);
  EXPECT_EQ(view.least_depth_m.at<float>(0, 0), 3) << "what is beyond the image does not count";
  EXPECT_EQ(Count(View(Depth(3, 0)).least_depth_m, 0), 12 * 12);
}

class DepthMemoryTest : public testing::Test {
 protected:
  void Add(double time_s, const FreeSpaceOptions& options = kOptions) {
    memory_.Add(MakeDepthView(SecondsToNanoseconds(time_s), {}, Depth(3, 3)), options);
  }
  /// Times of the selected views [tenths of a second].
  std::vector<int> Select(double time_s, const FreeSpaceOptions& options = kOptions) const {
    std::vector<int> times;
    for (const DepthView* view : memory_.Select(SecondsToNanoseconds(time_s), options)) {
      times.push_back(static_cast<int>(std::lround(10 * NanosecondsToSeconds(view->stamp_ns))));
    }
    return times;
  }

  DepthMemory memory_;
};

TEST_F(DepthMemoryTest, IsEmptyAtFirst) {
  EXPECT_EQ(memory_.size(), 0U);
  EXPECT_THAT(Select(1), IsEmpty());
}

TEST_F(DepthMemoryTest, KeepsViewsAnIntervalApart) {
  for (int i = 0; i <= 15; ++i) Add(i / 30.0);
  EXPECT_EQ(memory_.size(), 6U) << "every third of 16 frames";
}

TEST_F(DepthMemoryTest, ForgetsWhatIsTooOld) {
  for (int i = 0; i <= 40; ++i) Add(i * 0.1);
  EXPECT_GE(memory_.size(), 10U);
  EXPECT_LE(memory_.size(), 11U);
  Add(100);
  EXPECT_EQ(memory_.size(), 1U);
}

TEST_F(DepthMemoryTest, SelectsViewsAtDoubledAges) {
  for (int i = 0; i <= 10; ++i) Add(1 + i * 0.1);
  EXPECT_THAT(Select(2.1), ElementsAre(20, 19, 17, 13)) << "0.1, 0.2, 0.4 and 0.8 s ago";
}

TEST_F(DepthMemoryTest, SelectsEachViewOnce) {
  Add(1);
  EXPECT_THAT(Select(1.1), ElementsAre(10));
  EXPECT_THAT(Select(1.9), ElementsAre(10));
}

TEST_F(DepthMemoryTest, WithoutMemoryNothingIsKept) {
  FreeSpaceOptions none = kOptions;
  none.memory_s = 0;
  Add(1, none);
  EXPECT_EQ(memory_.size(), 0U);
  EXPECT_THAT(Select(1.1, none), IsEmpty());
}

TEST_F(DepthMemoryTest, CopiesAreIndependent) {
  Add(1);
  const DepthMemory copy = memory_;
  Add(2);
  EXPECT_EQ(copy.size(), 1U);
}

}  // namespace
}  // namespace ofm
