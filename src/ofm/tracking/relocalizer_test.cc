#include "ofm/tracking/relocalizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ofm/features/default_vocabulary.h"
#include "ofm/features/static_words.h"
#include "ofm/tracking/test_run.h"

namespace ofm {
namespace {

using test::FeatureWorld;
using test::MadeFrame;

constexpr int kFeatures = 60;

/// Features by which place `number` is known; each of them is turned by some bits.
std::shared_ptr<const FrameFeatures> FeaturesOfPlace(int number, int changed_bits = 0) {
  RandomEngine engine = MakeRandomEngine(7, number);
  std::vector<test::TestFeature> features(kFeatures);
  for (test::TestFeature& feature : features) {
    feature.descriptor = test::FlipBits(test::RandomDescriptor(engine), changed_bits);
  }
  return test::MakeTestFeatures(features);
}

/// A map of as many places, each seen by one keyframe, with words for those that `known` names.
std::shared_ptr<const MapSnapshot> MapOfPlaces(int count, const std::set<int>& known) {
  Map map(test::TestScales());
  for (int i = 0; i < count; ++i) {
    Keyframe keyframe = test::MakeTestKeyframe(FeaturesOfPlace(i));
    if (known.contains(i)) {
      keyframe.words =
          std::make_shared<const BagOfWords>(StaticWords(*keyframe.features, DefaultVocabulary()));
    }
    map.AddKeyframe(std::move(keyframe));
  }
  return map.Snapshot();
}

TrackingInput InputOf(std::uint32_t frame, std::shared_ptr<const FrameFeatures> features,
                      std::shared_ptr<const MapSnapshot> map) {
  TrackingInput input;
  input.frame_id = FrameId(frame);
  input.features = std::move(features);
  input.map = std::move(map);
  return input;
}

TEST(RelocalizationCandidates, BeginWithTheKeyframeThatLooksMostAlike) {
  const auto map = MapOfPlaces(40, {3, 17, 29});
  for (const int place : {3, 17, 29}) {
    const auto candidates =
        FindRelocalizationCandidates(InputOf(0, FeaturesOfPlace(place, 3), map), {}, {});
    ASSERT_FALSE(candidates.empty());
    EXPECT_EQ(candidates.front(), KeyframeId(place));
  }
}

TEST(RelocalizationCandidates, AreNotFoundByWhatMoves) {
  const auto map = MapOfPlaces(40, {3, 17});
  auto features = std::make_shared<FrameFeatures>(*FeaturesOfPlace(3));
  const auto still = FeaturesOfPlace(17);
  for (int i = 0; i < kFeatures; ++i) {
    features->static_probability.push_back(i < kFeatures / 2 ? 0.1F : 1.0F);
    if (i >= kFeatures / 2) features->descriptors[i] = still->descriptors[i];
  }
  EXPECT_EQ(FindRelocalizationCandidates(InputOf(0, features, map), {}, {}).front(),
            KeyframeId(17));
}

TEST(RelocalizationCandidates, ThenComesTheLastKnownPlace) {
  RelocalizationOptions options;
  options.similar_keyframes = 1;
  options.spread_keyframes = 0;
  const auto map = MapOfPlaces(40, {3});
  EXPECT_THAT(
      FindRelocalizationCandidates(InputOf(0, FeaturesOfPlace(3), map), KeyframeId(20), options),
      testing::ElementsAre(KeyframeId(3), KeyframeId(20)));
  EXPECT_THAT(
      FindRelocalizationCandidates(InputOf(0, FeaturesOfPlace(3), map), KeyframeId(99), options),
      testing::ElementsAre(KeyframeId(3)));
}

TEST(RelocalizationCandidates, HaveEachKeyframeOnceAndAllOfThemInTime) {
  const auto map = MapOfPlaces(43, {1, 2, 3, 4, 5});
  std::set<KeyframeId> tried;
  for (std::uint32_t frame = 0; frame < 10; ++frame) {
    const auto candidates =
        FindRelocalizationCandidates(InputOf(frame, FeaturesOfPlace(3), map), KeyframeId(3), {});
    EXPECT_EQ(std::set<KeyframeId>(candidates.begin(), candidates.end()).size(), candidates.size());
    EXPECT_LE(candidates.size(), 20U);
    tried.insert(candidates.begin(), candidates.end());
  }
  EXPECT_EQ(tried.size(), 43U);
}

/// The made world, of which a map knows every tenth frame.
class RelocalizerTest : public testing::Test {
 protected:
  RelocalizerTest() {
    for (std::uint32_t i = 0; i < 60; i += 10) {
      const MadeFrame frame = world_.Frame(i);
      test::AddWithDepth(map_, world_.model(), frame, frame.camera_from_world);
    }
  }

  std::optional<TrackingResult> Find(const MadeFrame& frame, const TrackingOptions& options = {}) {
    const PoseSearch search(world_.model(), options, 1);
    return Relocalize(search, test::MakeInput(frame, map_.Snapshot()), {});
  }

  FeatureWorld world_;
  Map map_{test::TestScales()};
};

TEST_F(RelocalizerTest, FindsTheCameraAnywhereInTheMap) {
  for (const std::uint32_t i : {5U, 23U, 38U, 52U}) {
    const MadeFrame frame = world_.Frame(i);
    const auto found = Find(frame);
    ASSERT_TRUE(found) << i;
    EXPECT_EQ(found->status, TrackingStatus::kRelocalized);
    test::ExpectPose(found->camera_from_world, frame.camera_from_world, 1e-3, 0.1);
    EXPECT_NE(map_.FindKeyframe(found->reference), nullptr);
  }
}

TEST_F(RelocalizerTest, FindsNothingWhereNothingIsSeenOrKnown) {
  EXPECT_FALSE(Find(test::MakeBlindFrame(world_.Frame(5))));
  test::FeatureWorldOptions other = test::DefaultWorld();
  other.landmarks.seed = 99;
  EXPECT_FALSE(Find(FeatureWorld(other).Frame(5)));
}

TEST_F(RelocalizerTest, WantsEnoughLandmarksToAgree) {
  const MadeFrame frame = world_.Frame(5);
  TrackingOptions options;
  options.min_relocalization_inliers = Find(frame)->inliers;
  EXPECT_TRUE(Find(frame, options));
  options.min_relocalization_inliers += 50;
  EXPECT_FALSE(Find(frame, options));
}

TEST_F(RelocalizerTest, ASecondSearchFindsWhatAPoorFirstPoseDidNot) {
  const MadeFrame frame = world_.Frame(5);
  const TrackingInput input = test::MakeInput(frame, map_.Snapshot());
  const PoseSearch search(world_.model(), {}, 1);
  const auto estimate = search.FromKeyframe(input, *input.map->keyframes.Find(KeyframeId(0)), 15);
  ASSERT_TRUE(estimate);
  CameraEstimate poor = *estimate;
  poor.matches.resize(40);
  poor.camera_from_world =
      RigidTransform(ExpSo3({0.004, 0.05, 0}), {0.02, 0, 0}) * poor.camera_from_world;
  const TrackingResult first = search.InLocalMap(input, poor);
  ASSERT_TRUE(HasPose(first.status));
  const TrackingResult second = search.InLocalMap(input, PoseSearch::EstimateOf(input, first));
  EXPECT_GT(second.inliers, first.inliers + 50);
  test::ExpectPose(second.camera_from_world, frame.camera_from_world, 1e-3, 0.1);
}

}  // namespace
}  // namespace ofm
