#include "ofm/base/ids.h"

#include <gtest/gtest.h>

#include <map>
#include <type_traits>
#include <unordered_set>

namespace ofm {
namespace {

TEST(Id, NamesNothingUntilItIsGivenAValue) {
  EXPECT_FALSE(FrameId().valid());
  EXPECT_TRUE(FrameId(0).valid());
  EXPECT_FALSE(FrameId(FrameId::kInvalid).valid());
}

TEST(Id, ComparesByValue) {
  EXPECT_EQ(LandmarkId(3), LandmarkId(3));
  EXPECT_NE(LandmarkId(3), LandmarkId(4));
  EXPECT_LT(LandmarkId(3), LandmarkId(4));
  EXPECT_LT(LandmarkId(4), LandmarkId()) << "an invalid id comes after all others";
}

TEST(Id, OrdersAMapByIssue) {
  const std::map<KeyframeId, char> map{
      {KeyframeId(2), 'c'}, {KeyframeId(0), 'a'}, {KeyframeId(1), 'b'}};
  std::string order;
  for (const auto& [id, letter] : map) order += letter;
  EXPECT_EQ(order, "abc");
}

TEST(Id, IsFoundInAHashedSet) {
  const std::unordered_set<InstanceId> set{InstanceId(5), InstanceId(9)};
  EXPECT_TRUE(set.contains(InstanceId(9)));
  EXPECT_FALSE(set.contains(InstanceId(6)));
}

TEST(Id, KindsDoNotMix) {
  static_assert(!std::is_convertible_v<FrameId, KeyframeId>);
  static_assert(!std::is_constructible_v<FrameId, KeyframeId>);
  static_assert(!std::is_convertible_v<int, FrameId>);
  static_assert(std::is_constructible_v<FrameId, std::uint32_t>);
  static_assert(sizeof(LandmarkId) == 4);
}

}  // namespace
}  // namespace ofm
