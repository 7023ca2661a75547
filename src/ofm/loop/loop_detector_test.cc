#include "ofm/loop/loop_detector.h"

#include <gmock/gmock.h>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Keyframes that share landmarks with the one before. What each shows is one of some places, told
/// by words; keyframes of one place share most of them.
class Walk {
 public:
  explicit Walk(const LoopOptions& options = {}) : detector_(options) {}

  /// A further keyframe, of place `place`.
  LoopCandidates Step(std::uint32_t place) {
    const KeyframeId last = map_.latest_keyframe();
    Keyframe keyframe = test::MakePlainKeyframe(60);
    keyframe.submap = submap;
    const KeyframeId id = map_.AddKeyframe(std::move(keyframe));
    if (last.valid()) {
      for (int i = 0; i < 20; ++i) {
        map_.AddObservation(map_.AddLandmark({0, 0, 2}, last, 20 + i), id, i);
      }
    }
    return detector_.Detect(*map_.Snapshot(), id, Words(place, id));
  }
  /// The same without looking.
  void StepBlindly(std::uint32_t place) {
    const KeyframeId id = map_.AddKeyframe(test::MakePlainKeyframe(60));
    detector_.Add(id, Words(place, id));
  }
  Map& map() { return map_; }

  SubmapId submap = SubmapId(0);  ///< of the next keyframe

 private:
  /// Of 20 words a keyframe has 16 in common with another of its place, 4 with one of a place next
  /// to it (there are six, in a ring), and two more with the keyframe before it.
  static BagOfWords Words(std::uint32_t place, KeyframeId id) {
    const std::uint32_t before = place < 6 ? (place + 5) % 6 : place;
    std::vector<WeightedWord> words;
    for (std::uint32_t i = 0; i < 8; ++i) words.push_back({100 * place + i, 1});
    for (std::uint32_t i = 0; i < 4; ++i) words.push_back({100 * place + 50 + i, 1});
    for (std::uint32_t i = 0; i < 4; ++i) words.push_back({100 * before + 50 + i, 1});
    for (std::uint32_t i = 0; i < 2; ++i) words.push_back({100000 + 2 * id.value + i, 1});
    for (std::uint32_t i = 0; i < 2; ++i) words.push_back({99998 + 2 * id.value + i, 1});
    return MakeBagOfWords(std::move(words));
  }

  Map map_{test::TestScales()};
  LoopDetector detector_;
};

/// Three keyframes at each of the places 0 to 5, which are 18.
void WalkAway(Walk& walk) {
  for (std::uint32_t i = 0; i < 18; ++i) EXPECT_THAT(walk.Step(i / 3).consistent, IsEmpty()) << i;
}

TEST(LoopDetector, ARowEndsWhereTheCameraWasLost) {
  Walk walk;
  WalkAway(walk);
  walk.Step(0);
  walk.Step(0);
  walk.submap = SubmapId(7);
  for (int i = 0; i < 2; ++i) {
    const LoopCandidates found = walk.Step(0);
    EXPECT_GE(found.similar, 3);
    EXPECT_THAT(found.consistent, IsEmpty()) << i;
  }
  EXPECT_THAT(walk.Step(0).consistent, testing::Not(IsEmpty()));
}

TEST(LoopDetector, ThreeInARowMakeACandidate) {
  Walk walk;
  WalkAway(walk);
  LoopCandidates found = walk.Step(0);
  EXPECT_EQ(found.similar, 3);
  EXPECT_THAT(found.consistent, IsEmpty()) << "the first in a row";
  found = walk.Step(0);
  EXPECT_THAT(found.consistent, IsEmpty()) << "the second";
  found = walk.Step(0);
  EXPECT_THAT(found.consistent, ElementsAre(KeyframeId(0), KeyframeId(1), KeyframeId(2)));
}

TEST(LoopDetector, NeighboursAndTheirsAreNoCandidates) {
  Walk walk;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(walk.Step(0).similar, 0) << i;
  EXPECT_EQ(walk.Step(0).similar, 1) << "the first is out of sight";
}

TEST(LoopDetector, ARowThatIsBrokenBeginsAnew) {
  Walk walk;
  WalkAway(walk);
  walk.Step(0);
  walk.Step(0);
  walk.Step(77);
  EXPECT_THAT(walk.Step(0).consistent, IsEmpty());
  walk.Step(0);
  EXPECT_FALSE(walk.Step(0).consistent.empty());
}

TEST(LoopDetector, ARowOfPlacesThatAreNoNeighboursIsNone) {
  Walk jumping({.consistent_keyframes = 2}), staying({.consistent_keyframes = 2});
  for (Walk* walk : {&jumping, &staying}) {
    WalkAway(*walk);
    walk->Step(0);
  }
  const LoopCandidates found = jumping.Step(3);
  EXPECT_GE(found.similar, 3);
  EXPECT_THAT(found.consistent, IsEmpty());
  EXPECT_FALSE(staying.Step(0).consistent.empty());
}

TEST(LoopDetector, KeyframesLessSimilarThanNeighboursAreNoCandidates) {
  Walk strict({.consistent_keyframes = 1}),
      lax({.similarity_share = 0.2, .consistent_keyframes = 1});
  for (Walk* walk : {&strict, &lax}) {
    for (int i = 0; i < 3; ++i) walk->Step(0);
    for (int i = 0; i < 3; ++i) walk->StepBlindly(9);
    walk->Step(1);
  }
  EXPECT_THAT(strict.Step(1).consistent, IsEmpty());
  EXPECT_FALSE(lax.Step(1).consistent.empty());
}

TEST(LoopDetector, RemovedKeyframesAreNoCandidates) {
  Walk walk({.consistent_keyframes = 1});
  WalkAway(walk);
  for (const std::uint32_t id : {0, 2}) walk.map().RemoveKeyframe(KeyframeId(id), KeyframeId(1));
  EXPECT_THAT(walk.Step(0).consistent, ElementsAre(KeyframeId(1)));
}

TEST(LoopDetector, GivesTheBestCandidatesOnly) {
  Walk walk({.max_candidates = 2, .consistent_keyframes = 1});
  WalkAway(walk);
  walk.Step(0);
  const LoopCandidates found = walk.Step(0);
  EXPECT_EQ(found.similar, 3);
  EXPECT_EQ(found.consistent.size(), 2U);
}

TEST(LoopDetector, AddEndsTheRow) {
  Walk walk;
  WalkAway(walk);
  walk.Step(0);
  walk.Step(0);
  walk.StepBlindly(0);
  EXPECT_THAT(walk.Step(0).consistent, IsEmpty());
}

}  // namespace
}  // namespace ofm
