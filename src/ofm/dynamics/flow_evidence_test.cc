#include "ofm/dynamics/flow_evidence.h"

#include <gtest/gtest.h>

#include "ofm/dynamics/test_frames.h"

namespace ofm {
namespace {

using test::Inner;
using test::MadeMover;
using test::MadePair;
using test::SharePositive;
using test::SmallMotion;

const cv::Rect kAll(0, 0, 80, 60);
const MadeMover kMover{.own_flow = {2, 0.5F}};  // 8 px to the side: 5 cm at 1.5 m
const cv::Rect& kCells = kMover.cells;

cv::Mat Evidence(const MadePair& made, const MotionOptions& options = {}) {
  return FlowEvidence(made.camera, made.pair(), made.motion(), options);
}

/// Cells within `radius` of `rect` and not in it.
cv::Mat Ring(const cv::Rect& rect, int radius) {
  cv::Mat ring = cv::Mat::zeros(kAll.size(), CV_8UC1);
  ring(Inner(rect, -radius) & kAll) = 255;
  ring(rect) = 0;
  return ring;
}

cv::Mat Off(const cv::Rect& rect) { return Ring(rect, 100); }

class FlowEvidenceOfMotion : public testing::TestWithParam<RigidTransform> {};

TEST_P(FlowEvidenceOfMotion, StaticSceneIsSaidToBeStaticEverywhere) {
  const MadePair made(GetParam());
  const MotionOptions options;
  const cv::Mat evidence = Evidence(made);
  ASSERT_EQ(evidence.type(), CV_32FC1);
  ASSERT_EQ(evidence.size(), made.flow.size());
  EXPECT_EQ(SharePositive(evidence, kAll), 0);
  const cv::Rect inside = Inner(kAll, 12);
  EXPECT_EQ(cv::countNonZero(evidence(inside) < 0.8 * options.flow.static_log_odds), inside.area());
}

TEST_P(FlowEvidenceOfMotion, MoverIsFoundAndNothingElse) {
  MadePair made(GetParam());
  made.Add(kMover);
  const cv::Mat evidence = Evidence(made);
  EXPECT_GT(SharePositive(evidence, Inner(kCells, 2)), 0.98);
  EXPECT_EQ(cv::countNonZero((evidence > 0) & Off(kCells)), 0);
}

INSTANTIATE_TEST_SUITE_P(Motions, FlowEvidenceOfMotion,
                         testing::Values(RigidTransform(), SmallMotion(),
                                         RigidTransform(Eigen::Quaterniond::Identity(),
                                                        {0, 0, -0.1}),
                                         RigidTransform(ExpSo3({0, 0.04, 0.02}), {0, 0, 0})));

TEST(FlowEvidence, NearObjectAtRestIsStaticThoughItsFlowIsLarger) {
  MadePair made({Eigen::Quaterniond::Identity(), {0.02, 0, 0}});
  made.Add({.depth_m = 0.8F});
  EXPECT_EQ(SharePositive(Evidence(made), kAll), 0);
}

TEST(FlowEvidence, MotionAlongTheRayIsSeenByDepth) {
  MadePair made(SmallMotion());
  MadeMover mover;
  made.Add(mover);
  EXPECT_EQ(SharePositive(Evidence(made), kCells), 0) << "at rest";
  mover.last_depth_m = 1.75F;
  made.Add(mover);
  EXPECT_GT(SharePositive(Evidence(made), Inner(kCells, 3)), 0.98);
}

TEST(FlowEvidence, WithoutDepthInTheLastFrameTheImageAloneDecides) {
  MadePair made(SmallMotion());
  made.Add(kMover);
  made.last.depth_m.setTo(0);
  const cv::Mat evidence = Evidence(made);
  EXPECT_GT(SharePositive(evidence, Inner(kCells, 2)), 0.98);
  EXPECT_EQ(cv::countNonZero((evidence > 0) & Off(kCells)), 0);
}

TEST(FlowEvidence, CellsWithoutTextureOrDepthSayNothing) {
  MadePair made(SmallMotion());
  made.Add(kMover);
  const cv::Rect upper(0, 0, 80, 30), lower(0, 30, 80, 30);
  made.current.texture(upper) = 0;
  made.current.depth_m(lower) = 0;
  EXPECT_EQ(cv::countNonZero(Evidence(made)), 0);
}

TEST(FlowEvidence, FlowOutOfTheImageSaysNothing) {
  MadePair made({});
  made.flow(cv::Rect(0, 0, 80, 6)) = cv::Scalar(0, -10);
  made.flow(cv::Rect(0, 54, 80, 6)) = cv::Scalar(0, 10);
  const cv::Mat evidence = Evidence(made);
  EXPECT_EQ(cv::countNonZero(evidence(cv::Rect(0, 0, 80, 6))), 0);
  EXPECT_EQ(cv::countNonZero(evidence(cv::Rect(0, 54, 80, 6))), 0);
}

TEST(FlowEvidence, FlowThatLeadsToOtherGreyValuesSaysNothing) {
  MadePair made(SmallMotion());
  made.Add(kMover);
  made.current.gray(cv::Rect(2 * kCells.x, 2 * kCells.y, 2 * kCells.width, kCells.height)) = 180;
  const cv::Rect upper(kCells.x, kCells.y, kCells.width, kCells.height / 2);
  const cv::Mat evidence = Evidence(made);
  EXPECT_EQ(cv::countNonZero(evidence(upper)), 0);
  EXPECT_GT(SharePositive(evidence, Inner(upper + cv::Point(0, 10), 2)), 0.98);
}

/// What the mover hid in the last frame had another depth there.
TEST(FlowEvidence, WhatAMoverUncoversIsForgiven) {
  MadePair made({});
  MadeMover mover = kMover;
  mover.own_flow = {3, 0};  // it came from the right
  made.Add(mover);
  EXPECT_EQ(cv::countNonZero((Evidence(made) > 0) & Off(kCells)), 0);

  // Where flow cannot tell that it moves, what was believed decides.
  made.current.texture(kCells) = 0;
  EXPECT_GT(cv::countNonZero((Evidence(made) > 0) & Off(kCells)), 10);
  made.belief(kCells) = 3;
  EXPECT_EQ(cv::countNonZero((Evidence(made) > 0) & Off(kCells)), 0);
}

TEST(FlowEvidence, FlowOfAMoverThatReachesOverItsEdgeIsForgiven) {
  MadePair made(SmallMotion());
  made.Add(kMover);
  const cv::Mat ring = Ring(kCells, 3);
  made.flow.setTo(
      cv::Scalar(made.flow.at<cv::Vec2f>(30, 40)[0], made.flow.at<cv::Vec2f>(30, 40)[1]), ring);
  const cv::Mat evidence = Evidence(made);
  EXPECT_EQ(cv::countNonZero((evidence > 0) & Off(kCells)), 0);
  EXPECT_GT(SharePositive(evidence, Inner(kCells, 2)), 0.98);
}

/// A second thing moves far from the first: not its neighbour, so nothing is forgiven.
TEST(FlowEvidence, MoverFarFromAnotherIsNotForgiven) {
  MadePair made(SmallMotion());
  MadeMover other{.cells = {60, 25, 12, 12}, .depth_m = 2.2F, .own_flow = {-2, 1}};
  made.Add(kMover);
  made.Add(other);
  made.belief(kCells) = 4;
  EXPECT_GT(SharePositive(Evidence(made), Inner(other.cells, 2)), 0.95);
}

/// Blur makes flow worse in the whole image: the same error means motion in a part of a sharp one.
TEST(FlowEvidence, ErrorsThatAllStaticCellsHaveAreNoMotion) {
  const auto disturb = [](MadePair& made, const cv::Rect& area) {
    RandomEngine engine = MakeRandomEngine(5, 0);
    for (int y = area.y; y < area.br().y; ++y) {
      for (int x = area.x; x < area.br().x; ++x) {
        const double angle = 2 * M_PI * UniformReal(engine);
        made.flow.at<cv::Vec2f>(y, x) +=
            cv::Vec2f(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
      }
    }
  };
  MadePair blurred({}), sharp({});
  disturb(blurred, kAll);
  disturb(sharp, kCells);
  EXPECT_LT(SharePositive(Evidence(blurred), kAll), 0.02);
  EXPECT_GT(SharePositive(Evidence(sharp), kCells), 0.9);
}

TEST(FlowEvidence, IsWithinTheLimitsOfTheOptions) {
  MadePair made(SmallMotion());
  made.Add({.own_flow = {8, 3}});
  MotionOptions options;
  options.flow.static_log_odds = -0.5;
  options.flow.moving_log_odds = 1.25;
  double least, most;
  cv::minMaxLoc(Evidence(made, options), &least, &most);
  EXPECT_EQ(least, -0.5);
  EXPECT_EQ(most, 1.25);
}

}  // namespace
}  // namespace ofm
