#include "ofm/dynamics/camera_motion.h"

#include <gtest/gtest.h>

#include "ofm/dynamics/test_frames.h"
#include "ofm/perception/dense_flow.h"
#include "ofm/sim/normal_deviate.h"

namespace ofm {
namespace {

using test::MadeMover;
using test::MadePair;
using test::SmallMotion;

CameraMotion Estimate(const MadePair& made, const RigidTransform& predicted,
                      const MotionOptions& options = {}) {
  RandomEngine engine = MakeRandomEngine(0, 1);
  return EstimateCameraMotion(made.camera, made.pair(), predicted, options, engine);
}

double ErrorOf_m(const CameraMotion& found, const RigidTransform& truth) {
  return (found.last_from_current.Inverse() * truth).translation().norm();
}

double ErrorOf_deg(const CameraMotion& found, const RigidTransform& truth) {
  return (found.last_from_current.Inverse() * truth).RotationAngle() * 180 / M_PI;
}

TEST(CameraMotion, IsThatOfExactFlow) {
  const MadePair made(SmallMotion());
  const CameraMotion motion = Estimate(made, {});
  EXPECT_TRUE(motion.is_measured);
  EXPECT_GT(motion.inlier_share, 0.99);
  EXPECT_LT(ErrorOf_m(motion, SmallMotion()), 1e-4);
  EXPECT_LT(ErrorOf_deg(motion, SmallMotion()), 0.005);
}

TEST(CameraMotion, IsFoundFromAFarPrediction) {
  const MadePair made(SmallMotion());
  const RigidTransform wrong(ExpSo3({0.05, -0.05, 0}), {-0.1, 0.1, 0.1});
  EXPECT_LT(ErrorOf_m(Estimate(made, wrong), SmallMotion()), 1e-3);
}

/// Two thirds of the image move as one; they are marked.
TEST(CameraMotion, WhatIsBelievedToMoveIsNotAsked) {
  MadePair made(SmallMotion());
  const MadeMover mover{.cells = {0, 0, 54, 60}, .own_flow = {1.5F, 0.5F}};
  made.Add(mover);
  EXPECT_GT(ErrorOf_m(Estimate(made, SmallMotion()), SmallMotion()), 0.01) << "not marked";
  made.belief(mover.cells) = 2;
  const CameraMotion motion = Estimate(made, {});
  EXPECT_TRUE(motion.is_measured);
  EXPECT_GT(motion.inlier_share, 0.6) << "all but what the mover hid in the last frame";
  EXPECT_LT(ErrorOf_m(motion, SmallMotion()), 1e-3);
}

TEST(CameraMotion, SmallMoverIsOutvotedWithoutAnyBelief) {
  MadePair made(SmallMotion());
  made.Add({.cells = {10, 10, 25, 40}, .own_flow = {3, 0}});
  const CameraMotion motion = Estimate(made, SmallMotion());
  EXPECT_LT(motion.inlier_share, 0.95);
  EXPECT_LT(ErrorOf_m(motion, SmallMotion()), 2e-3);
}

TEST(CameraMotion, TooFewPointsGiveThePrediction) {
  const RigidTransform predicted(ExpSo3({0, 0.01, 0}), {0.1, 0.2, 0.3});
  for (int reason = 0; reason < 4; ++reason) {
    MadePair made(SmallMotion());
    if (reason == 0) made.current.texture.setTo(0);
    if (reason == 1) made.current.depth_m.setTo(0);
    if (reason == 2) made.belief.setTo(1);
    if (reason == 3) made.flow.setTo(cv::Scalar(1000, 0));
    const CameraMotion motion = Estimate(made, predicted);
    EXPECT_FALSE(motion.is_measured) << reason;
    EXPECT_EQ(motion.inlier_share, 0) << reason;
    EXPECT_EQ(motion.last_from_current.translation(), predicted.translation()) << reason;
    EXPECT_EQ(motion.last_from_current.rotation().coeffs(), predicted.rotation().coeffs());
  }
}

TEST(CameraMotion, LeastNumberOfPointsIsThatOfTheOptions) {
  MadePair made(SmallMotion());
  made.current.texture.setTo(0);
  made.current.texture(cv::Rect(20, 20, 16, 12)).setTo(255);
  MotionOptions options;
  options.camera_motion.block_cells = 4;  // 4 × 3 blocks
  options.camera_motion.min_points = 12;
  EXPECT_TRUE(Estimate(made, SmallMotion(), options).is_measured);
  options.camera_motion.min_points = 13;
  EXPECT_FALSE(Estimate(made, SmallMotion(), options).is_measured);
}

/// Flow that no motion explains: nothing is taken for measured that hardly anything supports.
TEST(CameraMotion, FlowWithoutSenseGivesThePrediction) {
  MadePair made(SmallMotion());
  RandomEngine engine = MakeRandomEngine(3, 0);
  for (auto it = made.flow.begin<cv::Vec2f>(); it != made.flow.end<cv::Vec2f>(); ++it) {
    for (int i = 0; i < 2; ++i) (*it)[i] = static_cast<float>(40 * UniformReal(engine) - 20);
  }
  MotionOptions options;
  options.camera_motion.min_points = 60;
  const CameraMotion motion = Estimate(made, {}, options);
  EXPECT_FALSE(motion.is_measured);
  EXPECT_TRUE(motion.last_from_current.IsFinite());
}

/// Flow with an error of 1.2 px, as in a blurred image.
TEST(CameraMotion, IsFoundInBlurredImagesByTheWiderError) {
  MadePair made(SmallMotion());
  MotionOptions options;
  const double sigma_cells = 1.2 / options.lattice.cell_px;
  RandomEngine engine = MakeRandomEngine(5, 0);
  for (auto it = made.flow.begin<cv::Vec2f>(); it != made.flow.end<cv::Vec2f>(); ++it) {
    for (int i = 0; i < 2; ++i) (*it)[i] += static_cast<float>(sigma_cells * NormalDeviate(engine));
  }
  options.camera_motion.blurred_pixel_sigma = options.camera_motion.pixel_sigma = 0.2;
  EXPECT_FALSE(Estimate(made, SmallMotion(), options).is_measured) << "few agree to within 0.2 px";
  options.camera_motion.blurred_pixel_sigma = 1.5;
  const CameraMotion motion = Estimate(made, SmallMotion(), options);
  EXPECT_TRUE(motion.is_measured);
  EXPECT_GT(motion.inlier_share, 0.9);
  EXPECT_LT(ErrorOf_m(motion, SmallMotion()), 0.02);
}

/// Rendered frames with the noise of the sensor; the bounds are twice what was measured.
class CameraMotionOfRenderedFrames : public testing::TestWithParam<int> {
 protected:
  CameraMotion EstimateAt(FrameId id, bool mark_people) {
    const LatticeFrame current = lattice_.MakeFrame(recording_.frames[id.value]);
    const LatticeFrame last = lattice_.MakeFrame(recording_.frames[id.value - 1]);
    cv::Mat flow, belief(lattice_.size(), CV_32FC1, cv::Scalar(-0.3));
    cv::resize(DenseFlow().Compute(current.gray, last.gray), flow, lattice_.size(), 0, 0,
               cv::INTER_AREA);
    flow = flow / 2;
    if (mark_people) belief.setTo(3, lattice_.cells().SampleNearest(sequence_.MoverMask(id)));
    RandomEngine engine = MakeRandomEngine(0, id.value);
    return EstimateCameraMotion(lattice_.camera(), {current, last, flow, belief}, {}, options_,
                                engine);
  }

  MotionOptions options_;
  const test::WalkingRecording& recording_ = test::WalkingRecording::Get(GetParam());
  const SimSequence& sequence_ = recording_.sequence;
  MotionLattice lattice_{sequence_.camera(), options_.lattice};
};

TEST_P(CameraMotionOfRenderedFrames, IsThatOfTheSimulation) {
  const double bound = GetParam() < 4 ? 1 : 2.5;  // four people leave little of the room
  for (const std::uint32_t i : {1U, 5U, 11U}) {
    const RigidTransform truth = test::LastFromCurrent(sequence_, FrameId(i));
    const CameraMotion motion = EstimateAt(FrameId(i), true);
    EXPECT_TRUE(motion.is_measured);
    EXPECT_LT(ErrorOf_m(motion, truth), 0.006 * bound) << i;
    EXPECT_LT(ErrorOf_deg(motion, truth), 0.12 * bound) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(People, CameraMotionOfRenderedFrames, testing::Values(0, 1, 4));

}  // namespace
}  // namespace ofm
