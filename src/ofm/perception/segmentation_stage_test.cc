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
  IdealLattice cells() const { return {scene.camera(), LatticeOptions().cell_px}; }
};

/// The stage with the flow that it needs.
class FlowingStage {
 public:
  FlowingStage(const Walk& walk, std::unique_ptr<Segmenter> network,
               const SegmentationScheduleOptions& options)
      : walk_(walk),
        flow_(walk.scene.camera(), {}),
        stage_(std::move(network), options, flow_.lattice().cells()) {}

  Segmentation Process(std::uint32_t id) { return Process(walk_.Frame(id)); }
  Segmentation Process(const RgbdFrame& frame) {
    return stage_.Process(frame, flow_.Process(frame));
  }
  SegmentationStatistics statistics() const { return stage_.statistics(); }
  bool NeedsFlow() const { return stage_.NeedsFlow(); }

 private:
  const Walk& walk_;
  LatticeFlow flow_;
  SegmentationStage stage_;
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
  SegmentationStage stage(walk.Network(), Wait(1), walk.cells());
  EXPECT_FALSE(stage.NeedsFlow());
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
  FlowingStage stage(walk, walk.Network(), Wait(3));
  for (std::uint32_t id = 0; id < 7; ++id) {
    const Segmentation segmentation = stage.Process(id);
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
  FlowingStage stage(walk, walk.FailingNetwork(always), Wait(1));
  EXPECT_THROW(stage.Process(0), Error);
  SegmentationScheduleOptions options = Wait(1);
  options.on_failure = SegmentationFailure::kContinue;
  FlowingStage patient(walk, walk.FailingNetwork(always), options);
  const Segmentation segmentation = patient.Process(0);
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
  const auto fails = [](std::uint32_t id) { return id > 0 && id < 6; };
  FlowingStage stage(walk, walk.FailingNetwork(fails), options);
  for (std::uint32_t id = 0; id < 8; ++id) {
    const Segmentation segmentation = stage.Process(id);
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
  auto network = std::make_unique<ScriptedSegmenter>(
      [](const RgbdFrame&) -> Segmentation { throw std::logic_error("x"); });
  FlowingStage stage(walk, std::move(network), options);
  EXPECT_THROW(stage.Process(0), std::logic_error);
}

TEST(SegmentationStage, TheLatestMasksAreCarriedFromTheirFrameToNow) {
  const Walk walk;
  Gate gate;
  FlowingStage stage(walk, walk.Network(&gate), Latest());
  EXPECT_TRUE(stage.NeedsFlow());
  EXPECT_FALSE(stage.Process(0).age_frames) << "no frame waits for the network";
  gate.started.acquire();
  for (std::uint32_t id = 1; id < 4; ++id) {
    EXPECT_TRUE(stage.Process(id).instances.empty());
  }
  gate.allowed.release();
  gate.started.acquire();  // the network has answered for frame 0 and works on frame 3
  for (std::uint32_t id = 4; id < 6; ++id) {
    const Segmentation segmentation = stage.Process(id);
    EXPECT_EQ(segmentation.age_frames, static_cast<int>(id));
    ASSERT_EQ(segmentation.instances.size(), 1U);
    EXPECT_GT(Iou(segmentation.instances[0].mask, walk.Truth(id)), 0.9) << id;
  }
  gate.allowed.release();
  gate.started.acquire();  // frame 5
  const Segmentation segmentation = stage.Process(6);
  EXPECT_EQ(segmentation.age_frames, 3);
  EXPECT_GT(Iou(segmentation.instances.at(0).mask, walk.Truth(6)), 0.9);
  gate.allowed.release(100);
}

TEST(SegmentationStage, AnAnswerOfLongAgoIsCarriedAllTheSame) {
  const Walk walk;
  Gate gate;
  FlowingStage stage(walk, walk.Network(&gate), Latest());
  stage.Process(0);
  gate.started.acquire();
  for (std::uint32_t id = 1; id < 7; ++id) stage.Process(id);
  gate.allowed.release();
  gate.started.acquire();
  const Segmentation segmentation = stage.Process(7);
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
  FlowingStage stage(walk, walk.Network(&gate), options);
  stage.Process(0);
  gate.started.acquire();
  std::uint32_t id = 1;
  // The answer for frame 0 may need a moment; no other is allowed.
  while (!stage.Process(id).age_frames && id < 4) ++id;
  for (++id; id < 14; ++id) {
    const Segmentation segmentation = stage.Process(id);
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
  FlowingStage stage(walk, std::move(fails_first), Latest());
  std::uint32_t id = 0;
  stage.Process(id);
  gate.started.acquire();
  stage.Process(++id);
  gate.started.acquire();  // frame 0 has failed, frame 1 is worked on
  while (stage.Process(++id).instances.empty()) ASSERT_LT(id, 1000U);
  EXPECT_EQ(stage.statistics().failures, 1U);
  EXPECT_EQ(stage.statistics().first_error, "out of memory");
  EXPECT_GE(stage.statistics().network_runs, 2U);
}

TEST(SegmentationStage, SameFramesGiveTheSameMasksWhereFramesWait) {
  const Walk walk;
  FlowingStage a(walk, walk.Network(), Wait(4)), b(walk, walk.Network(), Wait(4));
  for (std::uint32_t id = 0; id < 6; ++id) {
    const Segmentation first = a.Process(id), second = b.Process(id);
    ASSERT_EQ(first.instances.size(), second.instances.size());
    EXPECT_EQ(cv::countNonZero(first.instances.at(0).mask != second.instances.at(0).mask), 0);
  }
}

TEST(SegmentationStage, AJumpBackInTimeDropsTheMasks) {
  const Walk walk;
  FlowingStage stage(walk, walk.Network(), Wait(6));
  for (std::uint32_t id = 3; id < 6; ++id) EXPECT_TRUE(stage.Process(id).age_frames);
  for (std::uint32_t id = 0; id < 3; ++id) {
    const Segmentation segmentation = stage.Process(id);
    EXPECT_FALSE(segmentation.age_frames);
    EXPECT_TRUE(segmentation.instances.empty());
  }
  EXPECT_TRUE(stage.Process(3).age_frames) << "the network ran again";
}

TEST(SegmentationStage, MissingFlowIsAProgrammersError) {
  const Walk walk;
  SegmentationStage stage(walk.Network(), Wait(2), walk.cells());
  EXPECT_THROW(stage.Process(walk.Frame(0), {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
