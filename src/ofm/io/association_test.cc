#include "ofm/io/association.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace ofm {
namespace {

using Stamps = std::vector<std::int64_t>;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<StampPair> Associate(const Stamps& first, const Stamps& second) {
  return AssociateStamps(first, second, 20);
}

TEST(AssociateStamps, PairsTheNearest) {
  EXPECT_THAT(Associate({0, 33, 66}, {5, 30, 70}),
              ElementsAre(StampPair{0, 0}, StampPair{1, 1}, StampPair{2, 2}));
}

TEST(AssociateStamps, LeavesOutWhatHasNoPartner) {
  EXPECT_THAT(Associate({0, 100, 200}, {101, 150}), ElementsAre(StampPair{1, 0}));
  EXPECT_THAT(Associate({}, {1}), IsEmpty());
  EXPECT_THAT(Associate({1}, {}), IsEmpty());
}

TEST(AssociateStamps, TheLimitItselfIsTooFar) {
  EXPECT_THAT(Associate({0}, {20}), IsEmpty());
  EXPECT_THAT(Associate({20}, {0}), IsEmpty());
  EXPECT_THAT(Associate({0}, {19}), ElementsAre(StampPair{0, 0}));
}

TEST(AssociateStamps, TheSmallestDifferenceWinsOverTheOrder) {
  // 10 is nearer to 12 than 0 is to 12: 0 goes without.
  EXPECT_THAT(Associate({0, 10}, {12}), ElementsAre(StampPair{1, 0}));
}

TEST(AssociateStamps, EachStampIsUsedOnce) {
  // 10 takes 12, so 14 has to take 28.
  EXPECT_THAT(Associate({10, 14}, {12, 28}), ElementsAre(StampPair{0, 0}, StampPair{1, 1}));
}

TEST(AssociateStamps, ALoserTakesItsNextBest) {
  EXPECT_THAT(Associate({10, 13}, {0, 12}), ElementsAre(StampPair{0, 0}, StampPair{1, 1}));
}

TEST(AssociateStamps, TiesGoToTheEarlier) {
  EXPECT_THAT(Associate({10}, {5, 15}), ElementsAre(StampPair{0, 0}));
  EXPECT_THAT(Associate({5, 15}, {10}), ElementsAre(StampPair{0, 0}));
}

TEST(AssociateStamps, RefusesUnsortedStamps) {
  EXPECT_THROW(Associate({2, 1}, {1}), std::logic_error);
  EXPECT_THROW(Associate({1}, {2, 1}), std::logic_error);
}

TEST(NearestStamp, FindsTheNearerNeighbour) {
  const Stamps stamps = {0, 10, 20};
  EXPECT_EQ(NearestStamp(stamps, -5), 0u);
  EXPECT_EQ(NearestStamp(stamps, 4), 0u);
  EXPECT_EQ(NearestStamp(stamps, 5), 0u);
  EXPECT_EQ(NearestStamp(stamps, 6), 1u);
  EXPECT_EQ(NearestStamp(stamps, 10), 1u);
  EXPECT_EQ(NearestStamp(stamps, 99), 2u);
  EXPECT_THROW(NearestStamp({}, 0), std::logic_error);
}

}  // namespace
}  // namespace ofm
