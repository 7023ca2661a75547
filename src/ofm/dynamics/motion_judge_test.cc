#include "ofm/dynamics/motion_judge.h"

#include <gtest/gtest.h>

#include "ofm/base/time.h"
#include "ofm/dynamics/test_frames.h"
#include "ofm/perception/lattice_flow.h"

namespace ofm {
namespace {

using test::ShareSet;

bool Same(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return cv::norm(a, b, cv::NORM_INF) == 0;
}

void ExpectSame(const MotionVerdict& a, const MotionVerdict& b) {
  EXPECT_TRUE(Same(a.belief, b.belief));
  EXPECT_TRUE(Same(a.flow_evidence, b.flow_evidence));
  EXPECT_EQ(a.camera_motion.is_measured, b.camera_motion.is_measured);
  EXPECT_EQ(a.camera_motion.last_from_current.translation(),
            b.camera_motion.last_from_current.translation());
}

/// A person walks through the view of a moving camera.
class MotionJudgeTest : public testing::Test {
 protected:
  MotionJudgeTest() {
    for (const RgbdFrame& frame : recording_.frames) {
      frames_.push_back(judge_.lattice().MakeFrame(frame));
    }
  }

  cv::Mat FlowToLast(const LatticeFrame& frame, const MotionState& state) {
    if (!state.last) return {};
    return flow_.FlowToLast(frame, *state.last);
  }
  MotionVerdict Process(const LatticeFrame& frame, MotionState& state, std::uint64_t id) {
    return judge_.Process({frame, FlowToLast(frame, state), prior_, id}, state);
  }
  MotionVerdict ProcessUpTo(std::uint32_t last, MotionState& state) {
    MotionVerdict verdict;
    for (std::uint32_t i = 0; i <= last; ++i) verdict = Process(frames_[i], state, i);
    return verdict;
  }

  static constexpr std::uint32_t kFrames = test::WalkingRecording::kFrames;
  const test::WalkingRecording& recording_ = test::WalkingRecording::Get(1);
  const SimSequence& sequence_ = recording_.sequence;
  MotionOptions options_;
  MotionJudge judge_{sequence_.camera(), options_};
  LatticeFlow flow_{sequence_.camera(), options_.lattice};
  std::vector<LatticeFrame> frames_;
  cv::Mat prior_ = cv::Mat::zeros(judge_.lattice().size(), CV_32FC1);
  MotionState state_;
};

TEST_F(MotionJudgeTest, FirstFrameKnowsNoMotion) {
  const MotionVerdict verdict = Process(frames_[0], state_, 0);
  EXPECT_TRUE(verdict.flow_evidence.empty());
  EXPECT_FALSE(verdict.camera_motion.is_measured);
  EXPECT_EQ(cv::countNonZero(verdict.belief < 0), prior_.size().area()) << "things stand still";
  ASSERT_TRUE(state_.last);
  EXPECT_EQ(state_.last->stamp_ns, frames_[0].stamp_ns);
  EXPECT_EQ(state_.memory.size(), 1U);
  EXPECT_TRUE(Same(state_.belief, verdict.belief));
}

TEST_F(MotionJudgeTest, WhatInstancesBringAlongIsBelievedAtOnce) {
  const cv::Rect block(20, 20, 15, 15);
  prior_(block) = 4;
  const MotionVerdict verdict = Process(frames_[0], state_, 0);
  EXPECT_EQ(cv::countNonZero(verdict.belief(block) > 0), block.area());
}

TEST_F(MotionJudgeTest, FollowsTheCamera) {
  const MotionVerdict verdict = ProcessUpTo(kFrames - 1, state_);
  EXPECT_TRUE(verdict.camera_motion.is_measured);
  const FrameId last(kFrames - 1);
  const RigidTransform truth =
      sequence_.WorldFromCamera(last).Inverse() * sequence_.WorldFromCamera(FrameId(0));
  const RigidTransform error = state_.camera_from_start * truth.Inverse();
  EXPECT_LT(error.translation().norm(), 0.06) << "of a way of 0.3 m, by flow alone";
  EXPECT_LT(error.RotationAngle() * 180 / M_PI, 1.1);
  const double elapsed_s = sequence_.SceneTime(last) - sequence_.SceneTime(FrameId(kFrames - 2));
  const Vector6d velocity = LogSe3(test::LastFromCurrent(sequence_, last).Inverse()) / elapsed_s;
  EXPECT_LT((state_.velocity - velocity).norm(), 0.15);
  EXPECT_GT(velocity.norm(), 0.2);
}

TEST_F(MotionJudgeTest, MoverIsBelievedToMoveWithoutAnyInstance) {
  const MotionVerdict verdict = ProcessUpTo(kFrames - 1, state_);
  const cv::Mat movers =
      judge_.lattice().cells().SampleNearest(sequence_.MoverMask(FrameId(kFrames - 1)));
  ASSERT_GT(cv::countNonZero(movers), 300);
  const cv::Mat has_depth = frames_[kFrames - 1].depth_m > 0;
  EXPECT_GT(ShareSet(verdict.belief > 0, (movers > 0) & has_depth), 0.7);
  EXPECT_LT(ShareSet(verdict.belief > 0, (movers == 0) & has_depth), 0.1);
}

TEST_F(MotionJudgeTest, FrameWithoutFlowBeginsAnew) {
  MotionState fresh;
  LatticeFrame again = frames_[4];
  for (const std::int64_t back_ns : {std::int64_t{0}, std::int64_t{1'000'000'000}}) {
    MotionState state;
    ProcessUpTo(4, state);
    again.stamp_ns = again.depth_stamp_ns = frames_[4].stamp_ns - back_ns;
    fresh = MotionState();
    ExpectSame(judge_.Process({again, {}, prior_, 5}, state), Process(again, fresh, 5));
    EXPECT_EQ(state.memory.size(), 1U);
    EXPECT_EQ(state.velocity.norm(), 0);
    EXPECT_EQ(state.camera_from_start.translation().norm(), 0);
  }
}

TEST_F(MotionJudgeTest, SameFramesGiveTheSameVerdict) {
  MotionState other;
  ExpectSame(ProcessUpTo(4, state_), ProcessUpTo(4, other));
}

TEST_F(MotionJudgeTest, StateIsAValue) {
  ProcessUpTo(3, state_);
  MotionState copy = state_;
  const MotionVerdict first = Process(frames_[4], state_, 4);
  Process(frames_[5], state_, 5);
  const MotionVerdict replayed = Process(frames_[4], copy, 4);
  ExpectSame(first, replayed);
  // Another judge continues where this one was.
  MotionState again = copy;
  MotionJudge other(sequence_.camera(), options_);
  ExpectSame(Process(frames_[5], copy, 5),
             other.Process({frames_[5], FlowToLast(frames_[5], again), prior_, 5}, again));
}

TEST_F(MotionJudgeTest, InputsAreLeftAlone) {
  const cv::Mat gray = frames_[0].gray.clone(), depth = frames_[0].depth_m.clone();
  const MotionVerdict first = Process(frames_[0], state_, 0);
  const cv::Mat belief = first.belief.clone();
  Process(frames_[1], state_, 1);
  EXPECT_TRUE(Same(frames_[0].gray, gray));
  EXPECT_TRUE(Same(frames_[0].depth_m, depth));
  EXPECT_TRUE(Same(first.belief, belief));
  EXPECT_EQ(cv::countNonZero(prior_), 0);
}

TEST_F(MotionJudgeTest, CameraIsCarriedOnWhereNothingCanBeMeasured) {
  ProcessUpTo(4, state_);
  const Vector6d velocity = state_.velocity;
  LatticeFrame blind = frames_[5];
  blind.depth_m = cv::Mat(blind.depth_m.size(), CV_32FC1, cv::Scalar(0));
  const MotionVerdict verdict = Process(blind, state_, 5);
  EXPECT_FALSE(verdict.camera_motion.is_measured);
  EXPECT_LT((state_.velocity - velocity).norm(), 1e-6);
  EXPECT_TRUE(Process(frames_[6], state_, 6).camera_motion.is_measured) << "and found again";
}

/// The last frame mirrored: flow finds nothing that hangs together.
TEST_F(MotionJudgeTest, NothingIsSaidAgainstAMotionThatFlowContradicts) {
  ProcessUpTo(7, state_);
  EXPECT_GT(state_.memory.size(), 1U);
  LatticeFrame mirrored = frames_[8];
  for (cv::Mat* image : {&mirrored.gray, &mirrored.depth_m, &mirrored.texture}) {
    cv::Mat flipped;
    cv::flip(*image, flipped, -1);
    *image = flipped;
  }
  const MotionVerdict verdict = Process(mirrored, state_, 8);
  EXPECT_TRUE(verdict.camera_motion.is_contradicted);
  EXPECT_TRUE(verdict.flow_evidence.empty());
  EXPECT_EQ(state_.memory.size(), 1U) << "earlier views are from places that are only guessed";
}

/// The same depth with the stamp of the next frame: taken from the camera's later place.
TEST_F(MotionJudgeTest, DepthIsPlacedWhereTheCameraWasWhenItWasTaken) {
  ProcessUpTo(4, state_);
  MotionState late = state_;
  LatticeFrame frame = frames_[5];
  Process(frame, state_, 5);
  frame.depth_stamp_ns += 33'333'000;
  Process(frame, late, 5);
  const std::int64_t later_ns = frame.stamp_ns + 100'000'000;
  const auto place = [&](const MotionState& state) {
    return state.memory.Select(later_ns, options_.free_space).front()->camera_from_start;
  };
  const RigidTransform step = place(late) * place(state_).Inverse();
  const RigidTransform expected = ExpSe3(NanosecondsToSeconds(33'333'000) * late.velocity);
  // Both or neither were kept: the memory takes a view per interval.
  if (state_.memory.Select(later_ns, options_.free_space).front()->stamp_ns == frame.stamp_ns) {
    EXPECT_LT((step.translation() - expected.translation()).norm(), 1e-9);
    EXPECT_GT(step.translation().norm(), 1e-4);
  } else {
    EXPECT_LT(step.translation().norm(), 1e-9);
  }
}

TEST(MotionJudge, TinyImagesAreJudgedByDepthAlone) {
  const PinholeCamera camera = MakeSimCamera(32, 24);
  MotionJudge judge(camera, {});
  LatticeFlow flow(camera, {});
  MotionState state;
  const cv::Mat prior = cv::Mat::zeros(judge.lattice().size(), CV_32FC1);
  RgbdFrame image;
  image.gray = cv::Mat(24, 32, CV_8UC1, cv::Scalar(80));
  MotionVerdict verdict;
  for (int i = 0; i < 20; ++i) {
    image.stamp_ns = image.depth_stamp_ns = 1 + i * 33'000'000;
    image.depth_m = cv::Mat(24, 32, CV_32FC1, cv::Scalar(3));
    if (i == 19) image.depth_m(cv::Rect(8, 8, 16, 12)) = 1;
    const LatticeStep step = flow.Process(image);
    verdict = judge.Process({step.frame, step.flow, prior, 1}, state);
    EXPECT_FALSE(verdict.camera_motion.is_measured);
    if (i < 19) {
      EXPECT_EQ(cv::countNonZero(verdict.belief > 0), 0);
    }
  }
  EXPECT_GT(verdict.belief.at<float>(3, 4), 0) << "stepped into free space";
  EXPECT_LT(verdict.belief.at<float>(0, 0), 0);
}

}  // namespace
}  // namespace ofm
