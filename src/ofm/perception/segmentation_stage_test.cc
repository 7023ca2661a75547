#include "ofm/perception/segmentation_stage.h"

#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/perception/carry_test_support.h"
#include "ofm/perception/schedule_test_support.h"

namespace ofm {
namespace {

using test::CarryScene;
using test::Gate;
using test::Iou;
using test::ScriptedSegmenter;

/// An object that moves 6 px a frame, and the network that sees it.
struct Walk {
  CarryScene scene;

  static cv::Point2f Place(std::uint32_t id) {
    return {100.0F + 6.0F * static_cast<float>(id), 120};
  }
  cv::Mat Truth(std::uint32_t id) const { return scene.Mask(Place(id)); }
  RgbdFrame Frame(std::uint32_t id) const { return scene.Frame(id, Place(id)); }
  Segmentation See(const RgbdFrame& frame) const {
    return {frame.id, {scene.MakeInstance(Place(frame.id.value))}};
  }
  std::unique_ptr<Segmenter> Network(Gate* gate = nullptr) const {
    return std::make_unique<ScriptedSegmenter>([this](const RgbdFrame& f) { return See(f); }, gate);
  }
  /// Fails on the frames that `fails` names.
  template <class Fails>
  std::unique_ptr<Segmenter> FailingNetwork(Fails fails) const {
    return std::make_unique<ScriptedSegmenter>([this, fails](const RgbdFrame& frame) {
      if (fails(frame.id.value)) throw Error("out of memory");
      return See(frame);
    });
  }
  Segmentation Process(SegmentationStage& stage, std::uint32_t id) const {
    const RgbdFrame frame = Frame(id);
    return stage.Process(frame, BuildFlowPyramid(frame.gray, {}));
  }
};

SegmentationScheduleOptions Wait(int every_nth) {
  SegmentationScheduleOptions options;
  options.every_nth = every_nth;
  return options;
}

SegmentationScheduleOptions Latest() {
  SegmentationScheduleOptions options;
  options.mode = SegmentationMode::kLatest;
  options.niceness = 0;
  return options;
}

TEST(SegmentationStage, WaitingForEveryFrameGivesWhatTheNetworkGives) {
  const Walk walk;
  SegmentationStage stage(walk.Network(), Wait(1), {});
  EXPECT_FALSE(stage.NeedsPyramid());
  for (std::uint32_t id = 0; id < 3; ++id) {
    const RgbdFrame frame = walk.Frame(id);
    const Segmentation segmentation = stage.Process(frame, {});
    EXPECT_EQ(segmentation.frame_id, frame.id);
    EXPECT_EQ(segmentation.age_frames, 0);
    ASSERT_EQ(segmentation.instances.size(), 1U);
    EXPECT_EQ(cv::countNonZero(segmentation.instances[0].mask != walk.Truth(id)), 0);
    EXPECT_EQ(segmentation.instances[0].id, InstanceId(3));
  }
  EXPECT_EQ(stage.statistics().network_runs, 3U);
  EXPECT_EQ(stage.statistics().mean_age_frames, 0);
}

TEST(SegmentationStage, BetweenTheNetworksFramesMasksAreCarried) {
  const Walk walk;
  SegmentationStage stage(walk.Network(), Wait(3), {});
  for (std::uint32_t id = 0; id < 7; ++id) {
    const Segmentation segmentation = walk.Process(stage, id);
    EXPECT_EQ(segmentation.frame_id, FrameId(id));
    EXPECT_EQ(segmentation.age_frames, static_cast<int>(id % 3));
    ASSERT_EQ(segmentation.instances.size(), 1U);
    EXPECT_GT(Iou(segmentation.instances[0].mask, walk.Truth(id)), 0.9) << id;
  }
  const SegmentationStatistics statistics = stage.statistics();
  EXPECT_EQ(statistics.frames, 7U);
  EXPECT_EQ(statistics.network_runs, 3U);
  EXPECT_NEAR(statistics.mean_age_frames, 6.0 / 7, 1e-9);
}

TEST(SegmentationStage, AWaitingNetworksErrorEndsTheRunUnlessTold) {
  const Walk walk;
  const auto always = [](std::uint32_t) { return true; };
  SegmentationStage stage(walk.FailingNetwork(always), Wait(1), {});
  EXPECT_THROW(walk.Process(stage, 0), Error);
  SegmentationScheduleOptions options = Wait(1);
  options.on_failure = SegmentationFailure::kContinue;
  SegmentationStage patient(walk.FailingNetwork(always), options, {});
  const Segmentation segmentation = walk.Process(patient, 0);
  EXPECT_TRUE(segmentation.instances.empty());
  EXPECT_FALSE(segmentation.age_frames);
  EXPECT_EQ(patient.statistics().failures, 1U);
  EXPECT_EQ(patient.statistics().frames_without, 1U);
  EXPECT_EQ(patient.statistics().first_error, "out of memory");
}

TEST(SegmentationStage, MasksAreCarriedOverAFailureAndDroppedWhenTooOld) {
  const Walk walk;
  SegmentationScheduleOptions options = Wait(1);
  options.on_failure = SegmentationFailure::kContinue;
  options.max_age_s = 0.1;  // three frames of 33 ms
  SegmentationStage stage(walk.FailingNetwork([](std::uint32_t id) { return id > 0 && id < 6; }),
                          options, {});
  for (std::uint32_t id = 0; id < 8; ++id) {
    const Segmentation segmentation = walk.Process(stage, id);
    const bool has_masks = id <= 3 || id >= 6;
    EXPECT_EQ(segmentation.instances.size(), has_masks ? 1U : 0U) << id;
    EXPECT_EQ(segmentation.age_frames.has_value(), has_masks) << id;
  }
  EXPECT_EQ(stage.statistics().expiries, 1U);
  EXPECT_EQ(stage.statistics().failures, 5U);
  EXPECT_EQ(stage.statistics().frames_without, 2U);
}

TEST(SegmentationStage, AProgrammersErrorIsNeverSwallowed) {
  const Walk walk;
  SegmentationScheduleOptions options = Wait(1);
  options.on_failure = SegmentationFailure::kContinue;
  SegmentationStage stage(std::make_unique<ScriptedSegmenter>([](const RgbdFrame&) -> Segmentation {
                            throw std::logic_error("x");
                          }),
                          options, {});
  EXPECT_THROW(walk.Process(stage, 0), std::logic_error);
}

TEST(SegmentationStage, TheLatestMasksAreCarriedFromTheirFrameToNow) {
  const Walk walk;
  Gate gate;
  SegmentationStage stage(walk.Network(&gate), Latest(), {});
  EXPECT_TRUE(stage.NeedsPyramid());
  EXPECT_FALSE(walk.Process(stage, 0).age_frames) << "no frame waits for the network";
  gate.started.acquire();
  for (std::uint32_t id = 1; id < 4; ++id) {
    EXPECT_TRUE(walk.Process(stage, id).instances.empty());
  }
  gate.allowed.release();
  gate.started.acquire();  // the network has answered for frame 0 and works on frame 3
  for (std::uint32_t id = 4; id < 6; ++id) {
    const Segmentation segmentation = walk.Process(stage, id);
    EXPECT_EQ(segmentation.age_frames, static_cast<int>(id));
    ASSERT_EQ(segmentation.instances.size(), 1U);
    EXPECT_GT(Iou(segmentation.instances[0].mask, walk.Truth(id)), 0.9) << id;
  }
  gate.allowed.release();
  gate.started.acquire();  // frame 5
  const Segmentation segmentation = walk.Process(stage, 6);
  EXPECT_EQ(segmentation.age_frames, 3);
  EXPECT_GT(Iou(segmentation.instances.at(0).mask, walk.Truth(6)), 0.9);
  gate.allowed.release(100);
}

TEST(SegmentationStage, AnAnswerOlderThanTheHistoryIsCarriedAllTheSame) {
  const Walk walk;
  Gate gate;
  SegmentationScheduleOptions options = Latest();
  options.history = 2;
  options.max_steps = 2;
  SegmentationStage stage(walk.Network(&gate), options, {});
  walk.Process(stage, 0);
  gate.started.acquire();
  for (std::uint32_t id = 1; id < 7; ++id) walk.Process(stage, id);
  gate.allowed.release();
  gate.started.acquire();
  const Segmentation segmentation = walk.Process(stage, 7);
  EXPECT_EQ(segmentation.age_frames, 7);
  ASSERT_EQ(segmentation.instances.size(), 1U);
  EXPECT_GT(Iou(segmentation.instances[0].mask, walk.Truth(7)), 0.85);
  gate.allowed.release(100);
}

TEST(SegmentationStage, ANetworkThatSaysNothingLosesItsMasksInTheEnd) {
  const Walk walk;
  Gate gate;
  gate.allowed.release();
  SegmentationScheduleOptions options = Latest();
  options.max_age_s = 0.15;
  SegmentationStage stage(walk.Network(&gate), options, {});
  walk.Process(stage, 0);
  gate.started.acquire();
  std::uint32_t id = 1;
  // The answer for frame 0 may need a moment; no other is allowed.
  while (!walk.Process(stage, id).age_frames && id < 4) ++id;
  for (++id; id < 14; ++id) {
    const Segmentation segmentation = walk.Process(stage, id);
    if (id < 5) continue;
    EXPECT_FALSE(segmentation.age_frames) << id;
    EXPECT_TRUE(segmentation.instances.empty()) << id;
  }
  EXPECT_LE(stage.statistics().expiries, 1U);
  EXPECT_EQ(stage.statistics().failures, 0U);
  gate.allowed.release(100);
}

TEST(SegmentationStage, ALatestNetworkThatThrowsIsCountedAndGoesOn) {
  const Walk walk;
  Gate gate;
  gate.allowed.release(100);
  auto fails_first = std::make_unique<ScriptedSegmenter>(
      [&](const RgbdFrame& frame) {
        if (frame.id == FrameId(0)) throw Error("out of memory");
        return walk.See(frame);
      },
      &gate);
  SegmentationStage stage(std::move(fails_first), Latest(), {});
  std::uint32_t id = 0;
  walk.Process(stage, id);
  gate.started.acquire();
  walk.Process(stage, ++id);
  gate.started.acquire();  // frame 0 has failed, frame 1 is worked on
  while (walk.Process(stage, ++id).instances.empty()) ASSERT_LT(id, 1000U);
  EXPECT_EQ(stage.statistics().failures, 1U);
  EXPECT_EQ(stage.statistics().first_error, "out of memory");
  EXPECT_GE(stage.statistics().network_runs, 2U);
}

TEST(SegmentationStage, SameFramesGiveTheSameMasksWhereFramesWait) {
  const Walk walk;
  SegmentationStage a(walk.Network(), Wait(4), {}), b(walk.Network(), Wait(4), {});
  for (std::uint32_t id = 0; id < 6; ++id) {
    const Segmentation first = walk.Process(a, id), second = walk.Process(b, id);
    ASSERT_EQ(first.instances.size(), second.instances.size());
    EXPECT_EQ(cv::countNonZero(first.instances.at(0).mask != second.instances.at(0).mask), 0);
  }
}

TEST(SegmentationStage, AMissingPyramidIsAProgrammersError) {
  const Walk walk;
  SegmentationStage stage(walk.Network(), Wait(2), {});
  EXPECT_THROW(stage.Process(walk.Frame(0), {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
