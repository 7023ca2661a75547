#include "ofm/map/submap.h"

#include <gtest/gtest.h>

#include "ofm/map/map_correction.h"
#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::CameraAt;
using test::MakePlainKeyframe;
using test::MaxDifference;

/// Keyframes 0 and 1 are of sub-map 0, keyframes 2 to 4 of sub-map 2; each sees the landmark of its
/// sub-map.
class Submaps : public testing::Test {
 protected:
  Submaps() {
    for (std::uint32_t i = 0; i < 5; ++i) {
      Keyframe keyframe = MakePlainKeyframe(3, CameraAt(i, 0, 0));
      keyframe.submap = i < 2 ? SubmapId(0) : i == 2 ? SubmapId() : SubmapId(2);
      map_.AddKeyframe(std::move(keyframe));
    }
    for (const std::uint32_t first : {0U, 2U}) {
      const LandmarkId id = map_.AddLandmark({1.0 * first, 0, 2}, KeyframeId(first), 0);
      for (std::uint32_t i = first + 1; i < (first == 0 ? 2 : 5); ++i) {
        map_.AddObservation(id, KeyframeId(i), 0);
      }
    }
  }
  /// Moves sub-map 2 by a metre along z into the world of sub-map 0.
  static MapCorrection Join(const MapSnapshot& map) {
    MapCorrection correction;
    correction.join = {SubmapId(2), SubmapId(0)};
    map.keyframes.ForEach([&](const Keyframe& keyframe) {
      const RigidTransform& before = keyframe.camera_from_world;
      const bool moves = keyframe.submap == SubmapId(2);
      correction.keyframes[keyframe.id] = {before, moves ? before * CameraAt(0, 0, 1) : before};
    });
    return correction;
  }

  Map map_{test::TestScales()};
};

TEST_F(Submaps, AreNumberedByTheKeyframeThatBeganThem) {
  EXPECT_EQ(map_.GetKeyframe(KeyframeId(2)).submap, SubmapId(2));
  const std::vector<SubmapSize> submaps = FindSubmaps(*map_.Snapshot());
  ASSERT_EQ(submaps.size(), 2U);
  EXPECT_EQ(submaps[0].id, SubmapId(0));
  EXPECT_EQ(submaps[0].keyframes, 2U);
  EXPECT_EQ(submaps[1].id, SubmapId(2));
  EXPECT_EQ(submaps[1].keyframes, 3U);
}

TEST_F(Submaps, EachWorldIsHeldByTheKeyframeThatBeganIt) {
  EXPECT_EQ(FindWorldHolder(*map_.Snapshot(), SubmapId(0)), KeyframeId(0));
  EXPECT_EQ(FindWorldHolder(*map_.Snapshot(), SubmapId(2)), KeyframeId(2));
  EXPECT_FALSE(FindWorldHolder(*map_.Snapshot(), SubmapId(1)).valid());
}

TEST_F(Submaps, AWorldIsHeldByItsOldestKeyframeWhereTheFirstIsGone) {
  map_.RemoveKeyframe(KeyframeId(2), KeyframeId(3));
  EXPECT_EQ(FindWorldHolder(*map_.Snapshot(), SubmapId(2)), KeyframeId(3));
}

TEST_F(Submaps, AWorldIsHeldByItsOwnFirstKeyframeWhereAnOlderSubmapJoined) {
  map_.JoinSubmaps(SubmapId(0), SubmapId(2));
  EXPECT_EQ(FindWorldHolder(*map_.Snapshot(), SubmapId(2)), KeyframeId(2));
}

TEST_F(Submaps, TheLargestHasMostKeyframesAndOfEqualsIsTheOlder) {
  EXPECT_EQ(LargestSubmap(*map_.Snapshot()), SubmapId(2));
  map_.RemoveKeyframe(KeyframeId(4), KeyframeId(3));
  EXPECT_EQ(LargestSubmap(*map_.Snapshot()), SubmapId(0));
  EXPECT_EQ(LargestSubmap(MapSnapshot()), SubmapId(0));
}

TEST_F(Submaps, ARemovedKeyframeIsOfTheSubmapOfItsAnchor) {
  map_.RemoveKeyframe(KeyframeId(3), KeyframeId(4));
  EXPECT_EQ(map_.FindSubmap(KeyframeId(3)), SubmapId(2));
  EXPECT_EQ(map_.Snapshot()->FindSubmap(KeyframeId(3)), SubmapId(2));
  EXPECT_FALSE(map_.FindSubmap(KeyframeId(9)).valid());
  EXPECT_FALSE(map_.FindSubmap(KeyframeId()).valid());
}

TEST_F(Submaps, AJoinMovesTheOneIntoTheWorldOfTheOther) {
  ApplyCorrection(Join(*map_.Snapshot()), map_);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const Keyframe& keyframe = map_.GetKeyframe(KeyframeId(i));
    EXPECT_EQ(keyframe.submap, SubmapId(0)) << i;
    EXPECT_LT(MaxDifference(keyframe.camera_from_world, CameraAt(i, 0, i < 2 ? 0 : 1)), 1e-12);
  }
  EXPECT_LT((map_.GetLandmark(LandmarkId(1)).position_in_world.z() - 3), 1e-12);
  EXPECT_LT((map_.GetLandmark(LandmarkId(0)).position_in_world.z() - 2), 1e-12);
  EXPECT_EQ(FindSubmaps(*map_.Snapshot()).size(), 1U);
}

TEST_F(Submaps, KeyframesAddedMeanwhileAreJoinedWithTheirSubmap) {
  const MapCorrection correction = Join(*map_.Snapshot());
  // They share no landmark with anyone: the sub-map alone tells with whom they move.
  for (const std::uint32_t submap : {0U, 2U, 0U}) {
    Keyframe keyframe = MakePlainKeyframe(3, CameraAt(9, 0, 0));
    keyframe.submap = SubmapId(submap);
    map_.AddKeyframe(std::move(keyframe));
  }
  ApplyCorrection(correction, map_);
  for (const std::uint32_t id : {5U, 6U, 7U}) {
    const Keyframe& keyframe = map_.GetKeyframe(KeyframeId(id));
    EXPECT_EQ(keyframe.submap, SubmapId(0));
    EXPECT_LT(MaxDifference(keyframe.camera_from_world, CameraAt(9, 0, id == 6 ? 1 : 0)), 1e-12);
  }
  EXPECT_EQ(test::FindProblem(map_), "");
}

TEST_F(Submaps, ALandmarkOfTwoIsFoundByTheCheckOfTests) {
  EXPECT_EQ(test::FindProblem(map_), "");
  map_.AddObservation(LandmarkId(0), KeyframeId(2), 1);
  EXPECT_EQ(test::FindProblem(map_), "landmark 0: seen from two sub-maps");
}

}  // namespace
}  // namespace ofm
