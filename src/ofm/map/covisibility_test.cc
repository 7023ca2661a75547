#include "ofm/map/covisibility.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::MakePlainKeyframe;
using Pairs = std::vector<std::pair<std::uint32_t, int>>;

constexpr int kFeatures = 40;

Pairs ToPairs(const std::vector<CovisibleKeyframe>& keyframes) {
  Pairs pairs;
  for (const CovisibleKeyframe& k : keyframes) pairs.emplace_back(k.id.value, k.shared_landmarks);
  return pairs;
}

/// Keyframe 0 sees landmarks 0 to 39; keyframe i sees the first `shared[i - 1]` of them.
Map MakeMap(const std::vector<int>& shared) {
  Map map(test::TestScales());
  map.AddKeyframe(MakePlainKeyframe(kFeatures));
  for (int i = 0; i < kFeatures; ++i) map.AddLandmark({0, 0, 2}, KeyframeId(0), i);
  for (const int count : shared) {
    Keyframe keyframe = MakePlainKeyframe(kFeatures);
    for (int i = 0; i < count; ++i) keyframe.landmarks[i] = LandmarkId(i);
    map.AddKeyframe(std::move(keyframe));
  }
  return map;
}

TEST(FindCovisible, GivesThoseThatShareMostFirst) {
  const Map map = MakeMap({20, 35, 17});
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(0))), (Pairs{{2, 35}, {1, 20}, {3, 17}}));
}

TEST(FindCovisible, OrdersEqualCountsById) {
  const Map map = MakeMap({20, 35, 20, 35, 20});
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(0))),
            (Pairs{{2, 35}, {4, 35}, {1, 20}, {3, 20}, {5, 20}}));
}

TEST(FindCovisible, LeavesOutTheKeyframeItself) {
  const Map map = MakeMap({20, 30});
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(2))), (Pairs{{0, 30}, {1, 20}}));
}

TEST(FindCovisible, LeavesOutThoseThatShareTooLittle) {
  const Map map = MakeMap({14, 15, 1});
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(0))), (Pairs{{2, 15}})) << "15 by default";
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(0), 1)), (Pairs{{2, 15}, {1, 14}, {3, 1}}));
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(0), 16)), Pairs{});
}

TEST(FindCovisible, IsNeverStale) {
  Map map = MakeMap({20, 30});
  map.RemoveKeyframe(KeyframeId(2), KeyframeId(0));
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(0))), (Pairs{{1, 20}}));
  for (int i = 0; i < 3; ++i) map.RemoveLandmark(LandmarkId(i));
  EXPECT_EQ(ToPairs(FindCovisible(map, KeyframeId(0))), (Pairs{{1, 17}}));
}

TEST(FindCovisible, SnapshotGivesNothingForAKeyframeThatIsGone) {
  Map map = MakeMap({20, 30});
  map.RemoveKeyframe(KeyframeId(1), KeyframeId(0));
  EXPECT_TRUE(FindCovisible(*map.Snapshot(), KeyframeId(1)).empty());
  EXPECT_TRUE(FindCovisible(*map.Snapshot(), KeyframeId()).empty());
}

TEST(FindCovisible, MapAndSnapshotAgreeAndAreSymmetricInARandomMap) {
  RandomEngine engine = MakeRandomEngine(3, 0);
  Map map = MakeMap({});
  for (int k = 0; k < 12; ++k) {
    Keyframe keyframe = MakePlainKeyframe(kFeatures);
    for (LandmarkId& id : keyframe.landmarks) {
      if (UniformIndex(engine, 3) > 0) id = LandmarkId(UniformIndex(engine, kFeatures));
    }
    map.AddKeyframe(std::move(keyframe));
  }
  for (int i = 0; i < 5; ++i) map.Fuse(LandmarkId(i), LandmarkId(i + 10));
  const auto snapshot = map.Snapshot();
  int pairs = 0;
  for (std::uint32_t k = 0; k < 13; ++k) {
    const auto covisible = FindCovisible(map, KeyframeId(k), 1);
    EXPECT_EQ(ToPairs(covisible), ToPairs(FindCovisible(*snapshot, KeyframeId(k), 1)));
    for (const CovisibleKeyframe& other : covisible) {
      const auto back = ToPairs(FindCovisible(map, other.id, 1));
      EXPECT_EQ(std::count(back.begin(), back.end(), std::pair(k, other.shared_landmarks)), 1);
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 100);
}

TEST(CountObservers, CountsHowManyOfTheLandmarksEachSees) {
  Map map = MakeMap({20, 10});
  const std::vector<LandmarkId> landmarks = {LandmarkId(5), LandmarkId(15), LandmarkId(25)};
  EXPECT_EQ(ToPairs(CountObservers(*map.Snapshot(), landmarks)), (Pairs{{0, 3}, {1, 2}, {2, 1}}));
}

TEST(CountObservers, IgnoresInvalidAndGoneLandmarksAndFollowsFusions) {
  Map map = MakeMap({20});
  map.RemoveLandmark(LandmarkId(5));
  map.Fuse(LandmarkId(6), LandmarkId(30));
  const std::vector<LandmarkId> landmarks = {LandmarkId(), LandmarkId(5), LandmarkId(99),
                                             LandmarkId(6)};
  EXPECT_EQ(ToPairs(CountObservers(*map.Snapshot(), landmarks)), (Pairs{{0, 1}, {1, 1}}));
  EXPECT_TRUE(CountObservers(*map.Snapshot(), {}).empty());
}

}  // namespace
}  // namespace ofm
