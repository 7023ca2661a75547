#include "ofm/pipeline/paced_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/base/timing.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Time that passes only when the test or a wait lets it.
struct MadeClock {
  std::int64_t now_ns = 5000 * kMs;
  std::vector<std::int64_t> waits;  // until when

  PacingClock Get() {
    return {[this] { return now_ns; },
            [this](std::int64_t until_ns) {
              waits.push_back(until_ns);
              now_ns = until_ns;
            }};
  }
};

/// Frames without images, 100 ms apart from 77 s on.
std::vector<RgbdFrame> Frames(std::uint32_t count) {
  std::vector<RgbdFrame> frames(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    frames[i].id = FrameId(i);
    frames[i].stamp_ns = 77 * kNanosecondsPerSecond + i * 100 * kMs;
  }
  return frames;
}

class PacedSourceTest : public testing::Test {
 protected:
  PacedSource Make(std::uint32_t count, std::size_t queue_frames = 1,
                   std::function<void(std::size_t)> before = {}) {
    return {std::make_unique<test::PlaySource>(Frames(count), std::move(before)), clock_.Get(),
            queue_frames};
  }

  MadeClock clock_;
};

TEST_F(PacedSourceTest, GivesTheFirstFrameAtOnce) {
  PacedSource source = Make(2);
  EXPECT_EQ(source.Next()->id, FrameId(0));
  EXPECT_THAT(clock_.waits, testing::IsEmpty());
}

TEST_F(PacedSourceTest, WaitsUntilEachFrameIsDue) {
  PacedSource source = Make(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(source.Next()->id, FrameId(i));
    clock_.now_ns += 30 * kMs;
  }
  EXPECT_FALSE(source.Next());
  EXPECT_THAT(clock_.waits, testing::ElementsAre(5100 * kMs, 5200 * kMs));
  EXPECT_EQ(source.dropped(), 0U);
}

TEST_F(PacedSourceTest, CountsFromTheFirstRequestNotFromItsConstruction) {
  PacedSource source = Make(2);
  clock_.now_ns += 7000 * kMs;
  EXPECT_EQ(source.Next()->id, FrameId(0));
  EXPECT_EQ(source.Next()->id, FrameId(1));
  EXPECT_THAT(clock_.waits, testing::ElementsAre(12100 * kMs));
}

TEST_F(PacedSourceTest, WhereOneFrameWaitsTheNewestIsGivenAndTheOthersAreCounted) {
  PacedSource source = Make(6);
  source.Next();
  clock_.now_ns += 350 * kMs;  // frames 1 to 3 are due
  EXPECT_EQ(source.Next()->id, FrameId(3));
  EXPECT_EQ(source.dropped(), 2U);
  EXPECT_EQ(source.Next()->id, FrameId(4)) << "which it had read ahead";
  EXPECT_THAT(clock_.waits, testing::ElementsAre(5400 * kMs));
  EXPECT_EQ(source.Next()->id, FrameId(5));
  EXPECT_FALSE(source.Next());
  EXPECT_EQ(source.dropped(), 2U);
}

TEST_F(PacedSourceTest, ALittleLateIsNotDropped) {
  PacedSource source = Make(4);
  source.Next();
  clock_.now_ns += 150 * kMs;
  EXPECT_EQ(source.Next()->id, FrameId(1));
  EXPECT_EQ(source.dropped(), 0U);
  EXPECT_THAT(clock_.waits, testing::IsEmpty());
}

TEST_F(PacedSourceTest, TheLastFrameIsGivenHoweverLate) {
  PacedSource source = Make(5);
  source.Next();
  clock_.now_ns += 10'000 * kMs;
  EXPECT_EQ(source.Next()->id, FrameId(4));
  EXPECT_EQ(source.dropped(), 3U);
  EXPECT_FALSE(source.Next());
}

TEST_F(PacedSourceTest, ASlowFrameLosesNothingWhereFramesCanWait) {
  PacedSource source = Make(8, 3);
  source.Next();
  clock_.now_ns += 350 * kMs;  // frames 1 to 3 are due
  for (std::uint32_t i = 1; i < 7; ++i) {
    EXPECT_EQ(source.Next()->id, FrameId(i));
    clock_.now_ns += 20 * kMs;
  }
  EXPECT_EQ(source.dropped(), 0U);
  EXPECT_THAT(clock_.waits, testing::ElementsAre(5500 * kMs, 5600 * kMs))
      << "frame 4 was due while those before it were worked on";
}

TEST_F(PacedSourceTest, OfMoreThanCanWaitTheOldestAreDropped) {
  PacedSource source = Make(9, 3);
  source.Next();
  clock_.now_ns += 550 * kMs;  // frames 1 to 5 are due
  EXPECT_EQ(source.Next()->id, FrameId(3));
  EXPECT_EQ(source.dropped(), 2U);
  clock_.now_ns += 200 * kMs;  // 4 and 5 wait, 6 and 7 come
  EXPECT_EQ(source.Next()->id, FrameId(5));
  EXPECT_EQ(source.dropped(), 3U);
  for (const std::uint32_t id : {6, 7, 8}) EXPECT_EQ(source.Next()->id, FrameId(id));
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.Next());
}

TEST_F(PacedSourceTest, FramesThatWaitAreGivenBeforeAnError) {
  PacedSource source = Make(5, 4, [](std::size_t index) {
    if (index == 3) throw Error("/x/3.png", "is truncated");
  });
  source.Next();
  clock_.now_ns += 10'000 * kMs;
  EXPECT_EQ(source.Next()->id, FrameId(1));
  EXPECT_EQ(source.Next()->id, FrameId(2));
  EXPECT_THROW(source.Next(), Error);
}

TEST_F(PacedSourceTest, AnErrorOfTheFirstFrameIsThrown) {
  PacedSource source = Make(5, 4, [](std::size_t) { throw Error("/x/0.png", "is truncated"); });
  EXPECT_THROW(source.Next(), Error);
}

TEST_F(PacedSourceTest, AQueueWithoutRoomIsAProgrammersError) {
  EXPECT_THROW(Make(5, 0), std::logic_error);
}

TEST_F(PacedSourceTest, TellsTheSizeOfTheRecording) { EXPECT_EQ(Make(5).size(), 5U); }

TEST_F(PacedSourceTest, AnEmptyRecordingHasNoFrame) { EXPECT_FALSE(Make(0).Next()); }

TEST_F(PacedSourceTest, AFrameReadBeforeAnErrorIsGivenBeforeIt) {
  PacedSource source = Make(5, 1, [](std::size_t index) {
    if (index == 3) throw Error("/x/3.png", "is truncated");
  });
  source.Next();
  clock_.now_ns += 10'000 * kMs;
  EXPECT_EQ(source.Next()->id, FrameId(2));
  EXPECT_EQ(source.dropped(), 1U);
  EXPECT_THROW(source.Next(), Error);
}

TEST(SteadyPacingClock, WaitsForItsOwnTime) {
  const PacingClock clock = SteadyPacingClock();
  const std::int64_t until_ns = clock.now_ns() + 20 * kMs;
  clock.wait_until_ns(until_ns);
  EXPECT_GE(clock.now_ns(), until_ns);
  clock.wait_until_ns(until_ns - 1000 * kMs);  // is over: returns at once
  EXPECT_LT(clock.now_ns() - until_ns, 900 * kMs);
}

}  // namespace
}  // namespace ofm
