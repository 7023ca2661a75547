#include "ofm/report/axis_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ofm {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

TEST(Interval, GrowsToWhatItIncludesAndLeavesOutWhatIsNotFinite) {
  Interval interval = EmptyInterval();
  EXPECT_TRUE(IsEmpty(interval));
  Include(interval, std::numeric_limits<double>::quiet_NaN());
  Include(interval, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(IsEmpty(interval));
  Include(interval, 3);
  Include(interval, -1);
  EXPECT_EQ(interval, (Interval{-1, 3}));
}

TEST(Interval, PaddedHasALength) {
  EXPECT_EQ(Padded(EmptyInterval(), 0.1), (Interval{0, 1}));
  EXPECT_EQ(Padded({0, 10}, 0.1), (Interval{-1, 11}));
  EXPECT_EQ(Padded({0, 0}, 0.1), (Interval{-0.5, 0.5}));
  EXPECT_EQ(Padded({-5, -5}, 0), (Interval{-5.5, -4.5}));
  EXPECT_GT(Padded({1e9, 1e9 + 1e-3}, 0).length(), 1);
}

TEST(LinearScale, RunsEitherWay) {
  const LinearScale down({0, 10}, 200, 100);
  EXPECT_DOUBLE_EQ(down(0), 200);
  EXPECT_DOUBLE_EQ(down(10), 100);
  EXPECT_DOUBLE_EQ(down(2.5), 175);
}

TEST(NiceTicks, AreRoundNumbersWithin) {
  EXPECT_THAT(NiceTicks({0, 10}, 6), ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(NiceTicks({0.13, 1.02}, 5),
              Pointwise(DoubleNear(1e-12), std::vector<double>{0.2, 0.4, 0.6, 0.8, 1.0}));
  EXPECT_THAT(NiceTicks({-1.2, 1.3}, 3), ElementsAre(-1, 0, 1));
  EXPECT_THAT(NiceTicks({0, 1}, 2), ElementsAre(0, 1));
}

TEST(NiceTicks, AreAboutAsManyAsWantedForAnyRange) {
  for (int exponent = -8; exponent <= 8; ++exponent) {
    for (const double mantissa : {1.0, 1.7, 2.4, 3.3, 4.9, 6.1, 7.7, 9.9}) {
      const double length = mantissa * std::pow(10, exponent);
      const std::vector<double> ticks = NiceTicks({-0.3 * length, 0.7 * length}, 6);
      EXPECT_GE(ticks.size(), 3U) << length;
      EXPECT_LE(ticks.size(), 10U) << length;
    }
  }
}

TEST(NiceTicks, WantALength) { EXPECT_THROW(NiceTicks({1, 1}, 5), std::logic_error); }

TEST(FormatTick, HasTheDecimalsThatTheDistanceNeeds) {
  EXPECT_EQ(FormatTick(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(FormatTick(-1e-17, 0.1), "0");
  EXPECT_EQ(FormatTick(20, 5), "20");
  EXPECT_EQ(FormatTick(-0.25, 0.05), "-0.25");
  EXPECT_EQ(FormatTick(3e-8, 1e-8), "3e-08");
  EXPECT_EQ(FormatTick(2e7, 1e7), "2e+07");
}

}  // namespace
}  // namespace ofm
