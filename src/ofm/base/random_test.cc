#include "ofm/base/random.h"

#include <gmock/gmock.h>

#include <array>
#include <set>
#include <stdexcept>
#include <vector>

namespace ofm {
namespace {

using ::testing::ElementsAre;

TEST(MakeRandomEngine, GivesTheSameDrawsForTheSameSeedAndStream) {
  RandomEngine a = MakeRandomEngine(7, 3), b = MakeRandomEngine(7, 3);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(a(), b());
}

// Results that were published with a seed must stay reproducible: these values never change.
TEST(MakeRandomEngine, DrawsPinnedValues) {
  RandomEngine engine = MakeRandomEngine(0, 0);
  EXPECT_EQ(engine(), 8892643065069030078u);
  EXPECT_EQ(engine(), 1801051935056765513u);
  EXPECT_EQ(MakeRandomEngine(42, 8)(), 12301745439263575628u);
  EXPECT_EQ(MakeRandomEngine(7, 42)(), 8352642561871152791u);
}

TEST(MakeRandomEngine, TellsNeighbouringSeedsAndStreamsApart) {
  std::set<std::uint64_t> first_draws;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (std::uint64_t stream = 0; stream < 20; ++stream) {
      first_draws.insert(MakeRandomEngine(seed, stream)());
    }
  }
  EXPECT_EQ(first_draws.size(), 400u);
}

TEST(UniformIndex, DrawsPinnedValues) {
  RandomEngine engine = MakeRandomEngine(42, 7);
  std::vector<std::uint32_t> draws(4);
  for (std::uint32_t& draw : draws) draw = UniformIndex(engine, 1000);
  EXPECT_THAT(draws, ElementsAre(851, 26, 882, 852));
}

TEST(UniformIndex, StaysBelowItsBound) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(UniformIndex(engine, 1), 0u);
  for (int i = 0; i < 1000; ++i) EXPECT_LT(UniformIndex(engine, 3), 3u);
  bool upper_half = false;
  for (int i = 0; i < 100; ++i) upper_half |= UniformIndex(engine, 0xffffffffu) > 0x80000000u;
  EXPECT_TRUE(upper_half);
}

TEST(UniformIndex, HitsEveryValueEquallyOften) {
  RandomEngine engine = MakeRandomEngine(5, 0);
  std::array<int, 8> hits{};
  for (int i = 0; i < 8000; ++i) ++hits[UniformIndex(engine, 8)];
  for (const int hit : hits) EXPECT_NEAR(hit, 1000, 150);  // five standard deviations
}

TEST(UniformIndex, NeedsABound) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  EXPECT_THROW(UniformIndex(engine, 0), std::logic_error);
}

TEST(UniformReal, DrawsPinnedValues) {
  RandomEngine engine = MakeRandomEngine(42, 7);
  engine.discard(4);
  EXPECT_EQ(UniformReal(engine), 0.53340238187867206);
  EXPECT_EQ(UniformReal(engine), 0.45352256879275132);
  EXPECT_EQ(UniformReal(engine), 0.59969823681531986);
}

TEST(UniformReal, FillsTheHalfOpenUnitIntervalEvenly) {
  RandomEngine engine = MakeRandomEngine(3, 0);
  double sum = 0, sum_of_squares = 0;
  constexpr int kDraws = 10000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = UniformReal(engine);
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    sum += x;
    sum_of_squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.015);
  EXPECT_NEAR(sum_of_squares / kDraws, 1.0 / 3, 0.015);
}

}  // namespace
}  // namespace ofm
