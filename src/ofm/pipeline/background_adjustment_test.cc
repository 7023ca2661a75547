#include "ofm/pipeline/background_adjustment.h"

#include <gtest/gtest.h>

#include "ofm/loop/test_ring.h"

namespace ofm {
namespace {

/// A part of a round, whose drift adjustment cannot take away but whose noise it can.
struct Adjusting {
  Adjusting() { made.AddUpTo(6); }
  test::RingMap made{{.landmarks = 300}};
  BackgroundAdjustment adjustment{made.world.model(), {}};
};

TEST(BackgroundAdjustment, GivesWhatTheWholeAdjustmentIs) {
  Adjusting a;
  const auto map = a.made.map.Snapshot();
  const auto expected = ComputeWholeAdjustment(*map, a.made.world.model(), {});
  a.adjustment.Start(map);
  const auto finished = a.adjustment.Wait();
  ASSERT_TRUE(finished && finished->correction && expected);
  EXPECT_EQ(finished->correction->keyframes.size(), 6U);
  for (const auto& [id, move] : expected->keyframes) {
    EXPECT_EQ(finished->correction->keyframes.at(id).after.translation(), move.after.translation());
  }
  EXPECT_EQ(finished->times.stages().count("loop_adjustment"), 1U);
}

TEST(BackgroundAdjustment, GivesAResultOnce) {
  Adjusting a;
  EXPECT_FALSE(a.adjustment.Take());
  EXPECT_FALSE(a.adjustment.Wait());
  a.adjustment.Start(a.made.map.Snapshot());
  EXPECT_TRUE(a.adjustment.Wait());
  EXPECT_FALSE(a.adjustment.Take());
}

TEST(BackgroundAdjustment, ANewerOneCancelsTheOneInProgress) {
  Adjusting a;
  a.adjustment.Start(a.made.map.Snapshot());
  a.made.AddUpTo(8);
  a.adjustment.Start(a.made.map.Snapshot());
  const auto finished = a.adjustment.Wait();
  ASSERT_TRUE(finished && finished->correction);
  EXPECT_EQ(finished->correction->keyframes.size(), 8U);
  EXPECT_FALSE(a.adjustment.Take()) << "the first one was forgotten";
}

TEST(BackgroundAdjustment, ACancelledOneGivesNothing) {
  Adjusting a;
  a.adjustment.Start(a.made.map.Snapshot());
  a.adjustment.Cancel();
  EXPECT_FALSE(a.adjustment.Wait());
}

TEST(BackgroundAdjustment, ThrowsWhatTheThreadThrew) {
  Adjusting a;
  BackgroundAdjustment wrong(a.made.world.model(), {.threads = 0});
  wrong.Start(a.made.map.Snapshot());
  EXPECT_THROW(wrong.Wait(), std::logic_error);
}

}  // namespace
}  // namespace ofm
