#include "ofm/dynamics/full_dynamics.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/dynamics/test_frames.h"

namespace ofm {
namespace {

using test::OneInstance;
using test::ShareSet;

constexpr std::uint32_t kFrames = test::WalkingRecording::kFrames;

/// Mode full with the flow that it needs.
class FlowingDynamics {
 public:
  FlowingDynamics(const DynamicsOptions& options, const PinholeCamera& camera,
                  const ClassPolicies& policies)
      : flow_(camera, options.motion.lattice), dynamics_(options, camera, policies) {}

  DynamicMask Process(const RgbdFrame& frame, const Segmentation& segmentation) {
    return dynamics_.Process(frame, segmentation, flow_.Process(frame));
  }

 private:
  LatticeFlow flow_;
  FullDynamics dynamics_;
};

class FullDynamicsTest : public testing::Test {
 protected:
  cv::Mat People(std::uint32_t i) const { return sequence_.MoverMask(FrameId(i)) > 0; }
  cv::Mat HasDepth(std::uint32_t i) const { return frames_[i].depth_m > 0; }
  Segmentation Nobody(std::uint32_t i) const { return {FrameId(i), {}}; }
  FlowingDynamics Make(const DynamicsOptions& options = {}) const {
    return {options, sequence_.camera(), ClassPolicies(options, {"person", "chair"})};
  }

  const test::WalkingRecording& recording_ = test::WalkingRecording::Get(1);
  const SimSequence& sequence_ = recording_.sequence;
  const std::vector<RgbdFrame>& frames_ = recording_.frames;
};

TEST_F(FullDynamicsTest, WalkerIsMaskedWithoutAnyInstance) {
  FlowingDynamics dynamics = Make();
  double found = 0, wrong = 0;
  int frames = 0;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const DynamicMask result = dynamics.Process(frames_[i], Nobody(i));
    ASSERT_EQ(result.mask.size(), frames_[i].gray.size());
    EXPECT_EQ(result.mask.type(), CV_8UC1);
    if (i == 0) {
      EXPECT_EQ(result.masked_share, 0) << "nothing has moved yet";
    }
    if (i < 7) continue;
    ++frames;
    found += ShareSet(result.mask, People(i) & HasDepth(i));
    wrong += ShareSet(result.mask, ~People(i) & HasDepth(i));
  }
  EXPECT_GT(found / frames, 0.75);
  EXPECT_LT(wrong / frames, 0.1);
}

TEST_F(FullDynamicsTest, InstanceOfADynamicClassIsMaskedFromTheFirstFrame) {
  FlowingDynamics dynamics = Make();
  for (std::uint32_t i = 0; i < 5; ++i) {
    const DynamicMask result = dynamics.Process(frames_[i], OneInstance(FrameId(i), People(i)));
    EXPECT_GT(ShareSet(result.mask, People(i)), 0.97) << i;
    EXPECT_LT(ShareSet(result.mask, ~People(i)), 0.1) << i;
  }
}

TEST_F(FullDynamicsTest, InstanceOfAnotherClassIsNotPresumedToMove) {
  Segmentation chair = OneInstance(FrameId(0), People(0));
  chair.instances[0].class_id = ClassId(1);
  EXPECT_EQ(Make().Process(frames_[0], chair).masked_share, 0);
}

TEST_F(FullDynamicsTest, StaticRoomIsKeptAndItsCameraFollowed) {
  const auto& [empty, frames] = test::WalkingRecording::Get(0);
  FlowingDynamics dynamics({}, empty.camera(), ClassPolicies({}, {}));
  for (std::uint32_t i = 0; i < 8; ++i) {
    const DynamicMask result = dynamics.Process(frames[i], {});
    EXPECT_LT(result.masked_share, 0.05) << i;
    EXPECT_NEAR(result.masked_share,
                cv::countNonZero(result.mask) / static_cast<double>(result.mask.total()), 1e-12);
    EXPECT_EQ(result.camera_motion.has_value(), i > 0);
    if (!result.camera_motion) continue;
    EXPECT_EQ(result.camera_motion->last_stamp_ns, empty.StampNs(FrameId(i - 1)));
    const RigidTransform truth = test::LastFromCurrent(empty, FrameId(i)).Inverse();
    const RigidTransform error = result.camera_motion->current_from_last * truth.Inverse();
    EXPECT_LT(error.translation().norm(), 0.005);
  }
}

TEST_F(FullDynamicsTest, StaticProbabilityGoesWithTheMask) {
  FlowingDynamics dynamics = Make();
  DynamicMask result;
  for (std::uint32_t i = 0; i < 8; ++i) {
    result = dynamics.Process(frames_[i], OneInstance(FrameId(i), People(i)));
  }
  ASSERT_EQ(result.static_probability.size(), result.mask.size());
  ASSERT_EQ(result.static_probability.type(), CV_8UC1);
  EXPECT_LT(cv::mean(result.static_probability, People(7))[0], 40);
  EXPECT_GT(cv::mean(result.static_probability, ~People(7))[0], 215);
}

TEST_F(FullDynamicsTest, SameFramesGiveTheSameMasks) {
  FlowingDynamics a = Make(), b = Make();
  for (std::uint32_t i = 0; i < 4; ++i) {
    const DynamicMask first = a.Process(frames_[i], Nobody(i));
    const DynamicMask second = b.Process(frames_[i], Nobody(i));
    EXPECT_EQ(cv::norm(first.mask, second.mask, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(first.static_probability, second.static_probability, cv::NORM_INF), 0);
  }
}

TEST_F(FullDynamicsTest, PersonWithoutAnyDepthIsMaskedByTheInstance) {
  FlowingDynamics dynamics = Make();
  for (std::uint32_t i = 0; i < 6; ++i) {
    RgbdFrame frame = frames_[i];
    frame.depth_m = frames_[i].depth_m.clone();
    frame.depth_m.setTo(0, People(i));
    const DynamicMask result = dynamics.Process(frame, OneInstance(FrameId(i), People(i)));
    EXPECT_GT(ShareSet(result.mask, People(i)), 0.95) << i;
    EXPECT_LT(ShareSet(result.mask, ~People(i)), 0.1) << i;
  }
}

TEST_F(FullDynamicsTest, OtherHalfServesWhereHalfOfTheImageIsMasked) {
  FlowingDynamics dynamics = Make();
  cv::Mat half = cv::Mat::zeros(frames_[0].gray.size(), CV_8UC1);
  half.colRange(0, half.cols / 2) = 255;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const DynamicMask result = dynamics.Process(frames_[i], OneInstance(FrameId(i), half));
    EXPECT_GT(ShareSet(result.mask, half), 0.5) << i;
    EXPECT_LT(ShareSet(result.mask, ~half & ~People(i)), 0.15) << i;
    EXPECT_EQ(result.camera_motion.has_value(), i > 0);
  }
}

TEST_F(FullDynamicsTest, MaskOverTheWholeImageIsNotBelieved) {
  FlowingDynamics dynamics = Make();
  const cv::Mat all(frames_[0].gray.size(), CV_8UC1, cv::Scalar(255));
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const DynamicMask result = dynamics.Process(frames_[i], OneInstance(FrameId(i), all));
    EXPECT_LT(ShareSet(result.mask, ~People(i) & HasDepth(i)), 0.15) << i;
    EXPECT_EQ(result.camera_motion.has_value(), i > 0);
  }
}

/// A piece of furniture is taken for a person; evidence of rest counts much.
class StandingInstance : public testing::Test {
 protected:
  double MeanWeight() const { return mean_weight_; }

  /// Share of it that is masked in the first frame and in the last.
  std::pair<double, double> Process(DynamicsOptions options) {
    options.instance_motion.static_log_odds_per_s = 40;
    const auto& [sequence, frames] = test::WalkingRecording::Get(0);
    FlowingDynamics dynamics(options, sequence.camera(), ClassPolicies(options, {"person"}));
    std::pair<double, double> shares;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const cv::Mat instances = sequence.InstanceMask(FrameId(i));
      const cv::Mat desk = instances == LargestInstance(sequence.InstanceMask(FrameId(0)));
      const DynamicMask result = dynamics.Process(frames[i], OneInstance(FrameId(i), desk));
      const double share = ShareSet(result.mask, desk & (frames[i].depth_m > 0));
      if (i == 0) shares.first = share;
      shares.second = share;
      mean_weight_ = cv::mean(result.static_probability, desk)[0] / 255;
      EXPECT_EQ(ShareSet(result.unmapped, desk), 1) << "what may move is never mapped";
    }
    return shares;
  }

 private:
  static int LargestInstance(const cv::Mat& instances) {
    int largest = 1;
    for (int id = 2; id < 256; ++id) {
      if (cv::countNonZero(instances == id) > cv::countNonZero(instances == largest)) largest = id;
    }
    return largest;
  }

  double mean_weight_ = 0;  // of its pixels in the last frame, 0 to 1
};

TEST_F(StandingInstance, ServesAsStaticStructureAfterAWhile) {
  const auto [first, last] = Process({});
  EXPECT_GT(first, 0.7);
  EXPECT_LT(last, 0.2);
  EXPECT_LT(MeanWeight(), 0.5) << "who stands still is worth less than furniture";
}

TEST_F(StandingInstance, CountsAsMuchAsFurnitureIfWanted) {
  DynamicsOptions options;
  options.instance_motion.standing_weight = 1;
  Process(options);
  EXPECT_GT(MeanWeight(), 0.8);
}

TEST_F(StandingInstance, OfAClassThatAlwaysMovesStaysMasked) {
  const auto [first, last] = Process({.dynamic_classes = {}, .always_dynamic = {"person"}});
  EXPECT_GT(first, 0.7);
  EXPECT_GT(last, 0.7);
}

TEST_F(FullDynamicsTest, WhatNeverMovesIsNeverMasked) {
  FlowingDynamics dynamics = Make({.dynamic_classes = {}, .never_dynamic = {"person"}});
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const DynamicMask result = dynamics.Process(frames_[i], OneInstance(FrameId(i), People(i)));
    cv::Mat inside;
    cv::erode(People(i), inside, cv::Mat::ones(9, 9, CV_8UC1));
    EXPECT_EQ(ShareSet(result.mask, inside), 0);
  }
}

TEST_F(FullDynamicsTest, DepthThatIsNoNumberIsTakenForNone) {
  FlowingDynamics a = Make(), b = Make();
  RandomEngine engine = MakeRandomEngine(1, 0);
  for (std::uint32_t i = 0; i < 4; ++i) {
    RgbdFrame with_nan = frames_[i], with_zero = frames_[i];
    with_nan.depth_m = frames_[i].depth_m.clone();
    with_zero.depth_m = frames_[i].depth_m.clone();
    for (int k = 0; k < 5000; ++k) {
      const auto place = static_cast<int>(UniformIndex(engine, with_nan.depth_m.total()));
      const cv::Point pixel(place % with_nan.depth_m.cols, place / with_nan.depth_m.cols);
      with_nan.depth_m.at<float>(pixel) = std::numeric_limits<float>::quiet_NaN();
      with_zero.depth_m.at<float>(pixel) = 0;
    }
    const DynamicMask first = a.Process(with_nan, Nobody(i));
    const DynamicMask second = b.Process(with_zero, Nobody(i));
    EXPECT_EQ(cv::norm(first.mask, second.mask, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(first.static_probability, second.static_probability, cv::NORM_INF), 0);
  }
}

TEST_F(FullDynamicsTest, FrameWithoutAnyDepthIsJudgedByItsInstances) {
  FlowingDynamics dynamics = Make();
  for (std::uint32_t i = 0; i < 6; ++i) {
    RgbdFrame frame = frames_[i];
    if (i != 1) frame.depth_m = cv::Mat(frame.depth_m.size(), CV_32FC1, cv::Scalar(0));
    const DynamicMask result = dynamics.Process(frame, OneInstance(FrameId(i), People(i)));
    EXPECT_GT(ShareSet(result.mask, People(i)), 0.95) << i;
    EXPECT_LT(ShareSet(result.mask, ~People(i)), 0.1) << i;
    if (i != 1) {
      EXPECT_FALSE(result.camera_motion);
    }
  }
}

TEST_F(FullDynamicsTest, StreamThatJumpsBackInTimeBeginsAnew) {
  FlowingDynamics dynamics = Make();
  for (std::uint32_t i = 4; i < 8; ++i) dynamics.Process(frames_[i], Nobody(i));
  const DynamicMask result = dynamics.Process(frames_[0], Nobody(0));
  EXPECT_EQ(result.masked_share, 0);
  EXPECT_FALSE(result.camera_motion);
}

TEST_F(FullDynamicsTest, TellsWhoIsFollowedUnderOneId) {
  FlowingDynamics dynamics = Make();
  for (std::uint32_t i = 0; i < 4; ++i) {
    const DynamicMask result = dynamics.Process(frames_[i], OneInstance(FrameId(i), People(i)));
    ASSERT_EQ(result.followed.size(), 1U) << i;
    EXPECT_EQ(result.followed[0].id, InstanceId(0));
    EXPECT_EQ(result.followed[0].class_id, ClassId(0));
    EXPECT_GT(ShareSet(result.followed[0].mask, People(i) & HasDepth(i)), 0.9);
  }
  EXPECT_TRUE(Make().Process(frames_[0], Nobody(0)).followed.empty());
}

}  // namespace
}  // namespace ofm
