#include "ofm/perception/async_segmenter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/base/thread_priority.h"
#include "ofm/perception/schedule_test_support.h"

namespace ofm {
namespace {

using test::Gate;
using test::ScriptedSegmenter;

SegmentationRequest Request(std::uint32_t id) {
  SegmentationRequest request;
  request.frame.id = FrameId(id);
  request.index = id;
  return request;
}

Segmentation Nothing(const RgbdFrame& frame) { return {frame.id, {}}; }

std::unique_ptr<Segmenter> Gated(Gate& gate) {
  return std::make_unique<ScriptedSegmenter>(Nothing, &gate);
}

TEST(AsyncSegmenter, AnswersWithTheFrameThatItSaw) {
  AsyncSegmenter segmenter(std::make_unique<ScriptedSegmenter>(Nothing), 0);
  EXPECT_FALSE(segmenter.TakeAnswer());
  segmenter.Submit(Request(4));
  segmenter.WaitForRuns(1);
  const auto answer = segmenter.TakeAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->request.index, 4U);
  EXPECT_EQ(answer->segmentation.frame_id, FrameId(4));
  EXPECT_FALSE(segmenter.TakeAnswer()) << "it is taken once";
  EXPECT_EQ(segmenter.status().runs, 1U);
  EXPECT_EQ(segmenter.status().failures, 0U);
}

TEST(AsyncSegmenter, ANewerFrameReplacesTheOneThatWaits) {
  Gate gate;
  AsyncSegmenter segmenter(Gated(gate), 0);
  segmenter.Submit(Request(0));
  gate.started.acquire();
  for (const std::uint32_t id : {1, 2, 3}) segmenter.Submit(Request(id));
  EXPECT_FALSE(segmenter.TakeAnswer()) << "the run under way goes on";
  gate.allowed.release(2);
  segmenter.WaitForRuns(1);
  gate.started.acquire();
  segmenter.WaitForRuns(2);
  const auto answer = segmenter.TakeAnswer();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->request.index, 3U) << "the newest answer replaced the one of frame 0";
  EXPECT_EQ(segmenter.status().runs, 2U);
}

TEST(AsyncSegmenter, GoesOnAfterARunThatThrew) {
  AsyncSegmenter segmenter(
      std::make_unique<ScriptedSegmenter>([](const RgbdFrame& frame) -> Segmentation {
        if (frame.id == FrameId(0)) throw Error("no memory");
        if (frame.id == FrameId(1)) throw 7;
        return Nothing(frame);
      }),
      0);
  for (std::uint32_t id = 0; id < 3; ++id) {
    segmenter.Submit(Request(id));
    segmenter.WaitForRuns(id + 1);
    EXPECT_EQ(segmenter.TakeAnswer().has_value(), id == 2);
  }
  const AsyncSegmenterStatus status = segmenter.status();
  EXPECT_EQ(status.runs, 3U);
  EXPECT_EQ(status.failures, 2U);
  EXPECT_EQ(status.first_error, "no memory");
}

TEST(AsyncSegmenter, AProgrammersErrorReachesTheCaller) {
  AsyncSegmenter segmenter(
      std::make_unique<ScriptedSegmenter>(
          [](const RgbdFrame&) -> Segmentation { throw std::logic_error("x"); }),
      0);
  segmenter.Submit(Request(0));
  segmenter.WaitForRuns(1);
  EXPECT_THROW(segmenter.TakeAnswer(), std::logic_error);
}

TEST(AsyncSegmenter, EndsAtAnyTime) {
  for (int submitted = 0; submitted < 4; ++submitted) {
    AsyncSegmenter segmenter(std::make_unique<ScriptedSegmenter>(Nothing), 0);
    for (int id = 0; id < submitted; ++id)
      segmenter.Submit(Request(static_cast<std::uint32_t>(id)));
  }
  Gate gate;
  bool has_ended = false;
  {
    AsyncSegmenter segmenter(std::make_unique<ScriptedSegmenter>(
                                 [&](const RgbdFrame& frame) {
                                   has_ended = true;
                                   return Nothing(frame);
                                 },
                                 &gate),
                             0);
    segmenter.Submit(Request(0));
    gate.started.acquire();
    segmenter.Submit(Request(1));
    gate.allowed.release(2);  // frame 1 may be begun before the destructor is
  }
  EXPECT_TRUE(has_ended) << "the run under way is waited for";
}

TEST(AsyncSegmenter, ItsThreadIsLessUrgent) {
  int niceness = -100;
  const int own = ThreadNiceness();
  {
    AsyncSegmenter segmenter(std::make_unique<ScriptedSegmenter>([&](const RgbdFrame& frame) {
                               niceness = ThreadNiceness();
                               return Nothing(frame);
                             }),
                             5);
    segmenter.Submit(Request(0));
    segmenter.WaitForRuns(1);
  }
#ifdef __linux__
  EXPECT_EQ(niceness, std::min(19, own + 5));
#endif
  EXPECT_EQ(ThreadNiceness(), own);
}

TEST(AsyncSegmenter, KnowsTheSegmentersClasses) {
  AsyncSegmenter segmenter(std::make_unique<ScriptedSegmenter>(Nothing), 0);
  EXPECT_THAT(segmenter.class_names(), testing::ElementsAre("person"));
}

}  // namespace
}  // namespace ofm
