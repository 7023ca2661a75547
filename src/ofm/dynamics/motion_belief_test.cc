#include "ofm/dynamics/motion_belief.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ofm {
namespace {

const cv::Size kSize(20, 12);
const cv::Rect kBlock(4, 3, 6, 5);
const BeliefOptions kOptions{
    .prior_log_odds = 0, .decay = 0.5, .limit = 3, .coupling = 0.25, .iterations = 4};

LatticeFrame FrameOfDepth(float depth_m) {
  LatticeFrame frame;
  frame.depth_m = cv::Mat(kSize, CV_32FC1, cv::Scalar(depth_m));
  return frame;
}

cv::Mat Plain(float value) { return {kSize, CV_32FC1, cv::Scalar(value)}; }

cv::Mat InBlock(float value) {
  cv::Mat image = Plain(0);
  image(kBlock) = value;
  return image;
}

cv::Mat FlowOf(float x, float y) { return {kSize, CV_32FC2, cv::Scalar(x, y)}; }

/// The cells where `image` is `value`, as a mask.
cv::Mat Where(const cv::Mat& image, float value) { return cv::abs(image - value) < 1e-6; }

TEST(CarryBelief, FollowsTheFlowAndFades) {
  const LatticeFrame frame = FrameOfDepth(2);
  const cv::Mat carried = CarryBelief(InBlock(2), frame, frame, FlowOf(-3, 1.2F), kOptions);
  // What is at x now was at x - 3: the block moved to the right by 3, up by 1.
  cv::Mat expected = Plain(0);
  expected(kBlock + cv::Point(3, -1)) = 1;
  EXPECT_LT(cv::norm(carried, expected, cv::NORM_INF), 1e-6);
}

TEST(CarryBelief, IsNoneWhereTheFlowComesFromOutside) {
  const LatticeFrame frame = FrameOfDepth(2);
  const cv::Mat carried = CarryBelief(Plain(2), frame, frame, FlowOf(-4, 0), kOptions);
  EXPECT_EQ(cv::countNonZero(carried(cv::Rect(0, 0, 4, 12))), 0);
  EXPECT_EQ(cv::countNonZero(Where(carried, 1)), 16 * 12);
}

TEST(CarryBelief, IsDroppedWhereTheDepthIsAnother) {
  LatticeFrame last = FrameOfDepth(2), current = FrameOfDepth(2);
  current.depth_m(cv::Rect(0, 0, 10, 12)) = 2.1F;  // may be the same a frame later
  current.depth_m(cv::Rect(10, 0, 10, 12)) = 3;
  const cv::Mat carried = CarryBelief(Plain(-2), last, current, FlowOf(0, 0), kOptions);
  EXPECT_EQ(cv::countNonZero(Where(carried, -1)), 10 * 12);
  EXPECT_EQ(cv::countNonZero(carried(cv::Rect(10, 0, 10, 12))), 0);
}

TEST(CarryBelief, IsKeptWithoutDepthButDroppedWhereDepthBeginsOrEnds) {
  const LatticeFrame known = FrameOfDepth(2), unknown = FrameOfDepth(0);
  for (const auto& [last, current] : {std::pair(known, unknown), std::pair(unknown, known)}) {
    const cv::Mat carried = CarryBelief(Plain(2), last, current, FlowOf(0, 0), kOptions);
    EXPECT_EQ(cv::countNonZero(carried), 0);
  }
  const cv::Mat carried = CarryBelief(Plain(2), unknown, unknown, FlowOf(0, 0), kOptions);
  EXPECT_EQ(cv::countNonZero(Where(carried, 1)), kSize.area());
}

TEST(RelaxBelief, WithoutCouplingOrIterationsItIsTheEvidence) {
  BeliefOptions none = kOptions;
  none.coupling = 0;
  EXPECT_EQ(cv::norm(RelaxBelief(InBlock(2), Plain(2), none), InBlock(2), cv::NORM_INF), 0);
  none = kOptions;
  none.iterations = 0;
  EXPECT_EQ(cv::norm(RelaxBelief(InBlock(2), Plain(2), none), InBlock(2), cv::NORM_INF), 0);
}

TEST(RelaxBelief, OneIterationAddsWhatTheFourNeighboursSay) {
  cv::Mat evidence = Plain(0);
  evidence.at<float>(5, 5) = 1;
  BeliefOptions once = kOptions;
  once.iterations = 1;
  const cv::Mat belief = RelaxBelief(evidence, Plain(2), once);
  cv::Mat expected = evidence.clone();
  for (const cv::Point cell : {cv::Point(4, 5), {6, 5}, {5, 4}, {5, 6}}) {
    expected.at<float>(cell) = 0.25F;
  }
  EXPECT_LT(cv::norm(belief, expected, cv::NORM_INF), 1e-6);
}

TEST(RelaxBelief, RowsEndAtTheImagesEdge) {
  cv::Mat evidence = Plain(0);
  evidence.at<float>(5, kSize.width - 1) = 1;
  const cv::Mat belief = RelaxBelief(evidence, Plain(2), kOptions);
  EXPECT_EQ(belief.at<float>(6, 0), 0);
  EXPECT_EQ(belief.at<float>(5, 0), 0);
  EXPECT_GT(belief.at<float>(6, kSize.width - 1), 0);
}

TEST(RelaxBelief, CellWithoutEvidenceFollowsItsNeighboursOfEqualDepth) {
  cv::Mat evidence = InBlock(1.5F);
  evidence.at<float>(5, 7) = 0;
  evidence.at<float>(4, 5) = -0.5;  // an outlier
  const cv::Mat belief = RelaxBelief(evidence, Plain(2), kOptions);
  EXPECT_GT(belief.at<float>(5, 7), 1);
  EXPECT_GT(belief.at<float>(4, 5), 0.5);
}

TEST(RelaxBelief, NothingIsSaidAcrossAnEdgeInDepth) {
  cv::Mat depth = Plain(3);
  depth(kBlock) = 2;
  const cv::Mat belief = RelaxBelief(InBlock(2), depth, kOptions);
  EXPECT_EQ(cv::countNonZero(belief), kBlock.area());
  EXPECT_EQ(cv::countNonZero(RelaxBelief(InBlock(2), Plain(3), kOptions)(cv::Rect(10, 3, 1, 5))), 5)
      << "without the edge it would";
}

TEST(RelaxBelief, SlopesAreNoEdges) {
  cv::Mat depth(kSize, CV_32FC1);
  for (int x = 0; x < kSize.width; ++x) depth.col(x) = 1.5F + 0.03F * static_cast<float>(x);
  cv::Mat evidence = Plain(0);
  evidence.col(0) = 2;
  const cv::Mat belief = RelaxBelief(evidence, depth, kOptions);
  EXPECT_EQ(cv::countNonZero(belief.colRange(0, 1 + kOptions.iterations) > 0),
            12 * (1 + kOptions.iterations));
}

TEST(RelaxBelief, CellsWithoutDepthAgreeMoreWeaklyAndWithOneAnotherAlone) {
  cv::Mat evidence = Plain(0);
  evidence.at<float>(5, 5) = 1;
  BeliefOptions once = kOptions;
  once.iterations = 1;
  const float among_unknown = RelaxBelief(evidence, Plain(0), once).at<float>(5, 6);
  const float among_known = RelaxBelief(evidence, Plain(2), once).at<float>(5, 6);
  EXPECT_GT(among_unknown, 0);
  EXPECT_LT(among_unknown, among_known);
  cv::Mat depth = Plain(2);
  depth.at<float>(5, 5) = 0;
  EXPECT_EQ(RelaxBelief(evidence, depth, once).at<float>(5, 6), 0);
}

TEST(RelaxBelief, LoudCellIsNotHeardMoreThanOthers) {
  const auto heard = [](float said) {
    cv::Mat evidence = Plain(0);
    evidence.at<float>(5, 5) = said;
    return RelaxBelief(evidence, Plain(2), kOptions).at<float>(5, 6);
  };
  EXPECT_GT(heard(2), heard(1));
  EXPECT_EQ(heard(100), heard(3));
}

TEST(RelaxBelief, StaysWithinItsLimits) {
  double least, most;
  for (const float sign : {-1.0F, 1.0F}) {
    const cv::Mat belief = RelaxBelief(Plain(sign * 50), Plain(2), kOptions);
    cv::minMaxLoc(belief, &least, &most);
    EXPECT_EQ(least, sign * kOptions.limit);
    EXPECT_EQ(most, sign * kOptions.limit);
  }
}

TEST(RelaxBelief, LeavesItsInputAlone) {
  const cv::Mat evidence = InBlock(2), before = evidence.clone();
  RelaxBelief(evidence, Plain(2), kOptions);
  EXPECT_EQ(cv::norm(evidence, before, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace ofm
