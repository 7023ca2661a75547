#include "ofm/features/orientation_consistency.h"

#include <gmock/gmock.h>

#include <numbers>

namespace ofm {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr float kDegree = std::numbers::pi_v<float> / 180;

TEST(ConsistentOrientations, KeepsTheCommonRotationAndDropsTheOthers) {
  std::vector<AnglePair> pairs;
  for (int i = 0; i < 40; ++i) pairs.push_back({9 * i * kDegree, (9 * i + 24) * kDegree});
  pairs.push_back({10 * kDegree, 190 * kDegree});
  pairs.push_back({50 * kDegree, 10 * kDegree});
  const std::vector<bool> kept = ConsistentOrientations(pairs);
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(kept[i]) << i;
  EXPECT_FALSE(kept[40]);
  EXPECT_FALSE(kept[41]);
}

TEST(ConsistentOrientations, ADifferenceAboutZeroDoesNotFallApart) {
  const std::vector<AnglePair> pairs = {
      {1 * kDegree, 359 * kDegree}, {359 * kDegree, 1 * kDegree}, {5 * kDegree, 5 * kDegree}};
  EXPECT_THAT(ConsistentOrientations(pairs, 30, 1), Each(true));
}

TEST(ConsistentOrientations, TurnsMayBeAdded) {
  const std::vector<AnglePair> pairs = {{0, 40 * kDegree}, {0, 400 * kDegree}, {0, -320 * kDegree}};
  EXPECT_THAT(ConsistentOrientations(pairs, 30, 1), Each(true));
}

TEST(ConsistentOrientations, KeepsTheFullestBinsOnly) {
  const std::vector<AnglePair> pairs = {{0, 0}, {0, 0}, {0, 1.5f}, {0, 1.5f}, {0, 3.0f}};
  EXPECT_THAT(ConsistentOrientations(pairs, 30, 2), ElementsAre(true, true, true, true, false));
  EXPECT_THAT(ConsistentOrientations(pairs, 30, 3), Each(true));
}

TEST(ConsistentOrientations, NoPairsGiveNoAnswers) {
  EXPECT_THAT(ConsistentOrientations({}), IsEmpty());
}

}  // namespace
}  // namespace ofm
