#include "ofm/dynamics/instance_motion.h"

#include <gtest/gtest.h>

namespace ofm {
namespace {

constexpr double kFrame_s = 1.0 / 30;

TEST(CountEvidence, CountsTexturedCellsUnderTheMaskAndThoseThatMove) {
  cv::Mat evidence(4, 4, CV_32FC1, cv::Scalar(0));
  cv::Mat mask(4, 4, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(0, 0, 2, 4)).setTo(255);
  evidence.at<float>(0, 0) = 5;
  evidence.at<float>(1, 0) = -1.5F;
  evidence.at<float>(2, 1) = 0.5F;
  evidence.at<float>(0, 3) = 5;  // off the mask
  const InstanceEvidence counted = CountEvidence(evidence, mask);
  EXPECT_EQ(counted.cells, 3);
  EXPECT_EQ(counted.moving, 2);
}

TEST(CountEvidence, TheFirstFrameHasNone) {
  EXPECT_EQ(CountEvidence({}, cv::Mat::ones(4, 4, CV_8UC1)).cells, 0);
}

TEST(UpdateInstanceMotion, StandingStillIsBelievedAfterAboutASecond) {
  const InstanceMotionOptions options;
  double log_odds = options.presumed_log_odds;
  int frames = 0;
  while (log_odds > 0 && frames < 100) {
    log_odds = UpdateInstanceMotion(log_odds, {100, 5}, kFrame_s, options);
    ++frames;
  }
  EXPECT_GT(frames, 10);
  EXPECT_LT(frames, 40);
}

TEST(UpdateInstanceMotion, MovingIsBelievedWithinTwoFramesOfLongStillness) {
  const InstanceMotionOptions options;
  double log_odds = -options.limit;
  log_odds = UpdateInstanceMotion(log_odds, {100, 80}, kFrame_s, options);
  log_odds = UpdateInstanceMotion(log_odds, {100, 80}, kFrame_s, options);
  EXPECT_GE(log_odds, 0);
}

TEST(UpdateInstanceMotion, LittleOrMixedEvidenceChangesNothing) {
  const InstanceMotionOptions options;
  EXPECT_EQ(UpdateInstanceMotion(1, {options.min_cells - 1, 0}, kFrame_s, options), 1);
  EXPECT_EQ(UpdateInstanceMotion(1, {100, 30}, kFrame_s, options), 1);
}

TEST(UpdateInstanceMotion, StaysWithinItsLimit) {
  const InstanceMotionOptions options;
  EXPECT_EQ(UpdateInstanceMotion(options.limit, {100, 100}, kFrame_s, options), options.limit);
  EXPECT_EQ(UpdateInstanceMotion(-options.limit, {100, 0}, 10, options), -options.limit);
}

}  // namespace
}  // namespace ofm
