#include "ofm/pipeline/delay_meter.h"

#include <gtest/gtest.h>

#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

TEST(DelayMeter, CountsFromWhenEachFrameWasDue) {
  constexpr std::int64_t kMs = 1'000'000;
  std::int64_t now_ns = 5000 * kMs;
  const PacingClock clock{[&] { return now_ns; },
                          [&](std::int64_t until_ns) { now_ns = until_ns; }};
  std::vector<RgbdFrame> frames(3);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].stamp_ns = 77'000 * kMs + static_cast<std::int64_t>(i) * 100 * kMs;
  }
  PacedSource source(std::make_unique<test::PlaySource>(frames), clock, 2);
  DelayMeter meter(source, clock);
  EXPECT_EQ(meter.delays().count, 0U);
  for (const std::int64_t work_ms : {130, 20, 60}) {  // the second frame is 30 ms late by the first
    PreparedFrame prepared;
    prepared.frame = *source.Next();
    now_ns += work_ms * kMs;
    meter.OnFrame({prepared, TrackingResult()});
  }
  const DurationStatistics delays = meter.delays();
  EXPECT_EQ(delays.count, 3U);
  EXPECT_DOUBLE_EQ(delays.max_ms, 130);
  EXPECT_DOUBLE_EQ(delays.median_ms, 60);
  EXPECT_DOUBLE_EQ(delays.mean_ms, (130 + 50 + 60) / 3.0);
}

}  // namespace
}  // namespace ofm
