#include "ofm/loop/loop_matching.h"

#include <gtest/gtest.h>

#include "ofm/loop/static_landmarks.h"
#include "ofm/loop/test_ring.h"

namespace ofm {
namespace {

constexpr int kRound = 24;

class LoopMatching : public testing::Test {
 protected:
  LoopMatching() {
    made_.AddUpTo(kRound + 1);
    for (const int shown : made_.world.Look(0).shown) shown_by_first_.push_back(shown);
    for (const int shown : made_.world.Look(kRound).shown) shown_by_last_.push_back(shown);
  }
  const Keyframe& Last() const { return made_.map.GetKeyframe(KeyframeId(kRound)); }
  /// True where the landmark of the first keyframe is what the last one's feature shows.
  bool IsRight(const LoopMatch& match) const {
    const int feature = made_.map.GetLandmark(match.landmark).FeatureIn(KeyframeId(0));
    return feature >= 0 && shown_by_first_[feature] == shown_by_last_[match.feature];
  }
  std::vector<LoopMatch> Match(double min_probability = 0.5) {
    return MatchPlace(*made_.map.Snapshot(), Last(), {KeyframeId(0)}, min_probability);
  }
  void MakeMoving(LandmarkId id) {
    for (int i = 0; i < 12; ++i) made_.map.UpdateStaticProbability(id, 0);
  }

  test::RingMap made_;
  std::vector<int> shown_by_first_, shown_by_last_;
};

TEST_F(LoopMatching, FindsTheSameThingsByTheirDescriptors) {
  const std::vector<LoopMatch> matches = Match();
  EXPECT_GE(matches.size(), 100U);
  int wrong = 0;
  for (const LoopMatch& match : matches) wrong += !IsRight(match);
  EXPECT_EQ(wrong, 0);
}

TEST_F(LoopMatching, EachFeatureAndEachLandmarkIsMatchedOnce) {
  const auto map = made_.map.Snapshot();
  const std::vector<LoopMatch> matches =
      MatchPlace(*map, Last(), KeyframesAbout(*map, KeyframeId(0)), 0.5);
  std::set<int> features;
  std::set<LandmarkId> landmarks;
  for (const LoopMatch& match : matches) {
    EXPECT_TRUE(features.insert(match.feature).second);
    EXPECT_TRUE(landmarks.insert(match.landmark).second);
  }
  EXPECT_GE(matches.size(), Match().size());
}

TEST_F(LoopMatching, LandmarksThatBothSeeAreNoMatches) {
  const std::vector<LoopMatch> before = Match();
  made_.map.Fuse(Last().landmarks[before[0].feature], before[0].landmark);
  EXPECT_EQ(Match().size(), before.size() - 1);
  EXPECT_NE(Match()[0].landmark, before[0].landmark);
}

TEST_F(LoopMatching, MovingLandmarksOfEitherSideAreNotMatched) {
  const std::vector<LoopMatch> before = Match();
  MakeMoving(before[0].landmark);
  MakeMoving(Last().landmarks[before[1].feature]);
  EXPECT_EQ(Match().size(), before.size() - 2);
  EXPECT_EQ(Match(0).size(), before.size());
}

TEST_F(LoopMatching, MovingLandmarksAreNotOfAPlace) {
  const std::vector<KeyframeId> place = {KeyframeId(0), KeyframeId(1)};
  const std::vector<LandmarkId> before = LandmarksOf(*made_.map.Snapshot(), place, 0.5);
  MakeMoving(before.front());
  const std::vector<LandmarkId> after = LandmarksOf(*made_.map.Snapshot(), place, 0.5);
  EXPECT_EQ(after.size(), before.size() - 1);
  EXPECT_EQ(after.front(), before[1]);
}

TEST_F(LoopMatching, MovingFeaturesAndLandmarksAreNotStatic) {
  const auto count_static = [&](const Keyframe& keyframe) {
    int count = 0;
    for (std::size_t i = 0; i < keyframe.features->size(); ++i) {
      count += IsStatic(*made_.map.Snapshot(), keyframe, static_cast<int>(i), 0.5);
    }
    return count;
  };
  const int all = static_cast<int>(Last().features->size());
  EXPECT_EQ(count_static(Last()), all);
  MakeMoving(Last().landmarks[3]);
  auto features = std::make_shared<FrameFeatures>(*Last().features);
  features->static_probability.assign(all, 1);
  features->static_probability[7] = 0.2F;
  Keyframe keyframe = Last();
  keyframe.features = features;
  EXPECT_EQ(count_static(keyframe), all - 2);
}

TEST_F(LoopMatching, KeyframesAboutAPlaceBeginWithIt) {
  const std::vector<KeyframeId> about = KeyframesAbout(*made_.map.Snapshot(), KeyframeId(5));
  EXPECT_EQ(about.front(), KeyframeId(5));
  EXPECT_GE(about.size(), 3U);
  EXPECT_LE(about.size(), 11U);
}

TEST_F(LoopMatching, SearchFindsWhatIsWithinTheRadiusOnly) {
  std::vector<Landmark> landmarks;
  for (const LandmarkId id : made_.map.GetKeyframe(KeyframeId(0)).landmarks) {
    landmarks.push_back(made_.map.GetLandmark(id));
  }
  const MeasurementModel model = made_.world.model();
  const RigidTransform pose = made_.world.Truth(kRound);
  const auto found = SearchByProjection(model, Last(), landmarks, {pose, 4, 50, 0.5});
  EXPECT_GE(found.size(), 100U);
  int wrong = 0;
  for (const LoopMatch& match : found) wrong += !IsRight(match);
  EXPECT_LE(wrong, 1);
  const RigidTransform turned = RigidTransform(ExpSo3({0, 0.03, 0}), {0, 0, 0}) * pose;
  EXPECT_LT(SearchByProjection(model, Last(), landmarks, {turned, 4, 50, 0.5}).size(), 10U)
      << "16 px off";
}

}  // namespace
}  // namespace ofm
