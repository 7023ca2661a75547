// What the map knows of a landmark: fusion, appearance and sightings.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "ofm/map/map.h"
#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::CameraAt;
using test::FindProblem;
using test::FlipBits;
using test::MakePlainKeyframe;
using test::MakeTestFeatures;
using test::MakeTestKeyframe;

const Eigen::Vector3d kPoint(0, 0, 2);

Map MakeMap(int keyframes) {
  Map map(test::TestScales());
  for (int i = 0; i < keyframes; ++i)
    map.AddKeyframe(MakePlainKeyframe(8, CameraAt(0.1 * i, 0, 0)));
  return map;
}

TEST(MapFuse, HandsOverTheObservationsAndTheName) {
  Map map = MakeMap(3);
  const LandmarkId from = map.AddLandmark(kPoint, KeyframeId(1), 0);
  map.AddObservation(from, KeyframeId(2), 3);
  const LandmarkId into = map.AddLandmark(kPoint, KeyframeId(0), 0);
  map.Fuse(from, into);
  EXPECT_EQ(map.landmarks().Find(from), nullptr);
  EXPECT_EQ(map.FindLandmark(from), map.FindLandmark(into));
  EXPECT_EQ(map.GetLandmark(into).FeatureIn(KeyframeId(1)), 0);
  EXPECT_EQ(map.GetLandmark(into).FeatureIn(KeyframeId(2)), 3);
  EXPECT_EQ(map.GetKeyframe(KeyframeId(2)).landmarks[3], into);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(MapFuse, KeepsOneFeatureWhereAKeyframeSawBoth) {
  Map map = MakeMap(1);
  const LandmarkId from = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const LandmarkId into = map.AddLandmark(kPoint, KeyframeId(0), 1);
  map.Fuse(from, into);
  EXPECT_FALSE(map.GetKeyframe(KeyframeId(0)).landmarks[0].valid());
  EXPECT_EQ(map.GetKeyframe(KeyframeId(0)).landmarks[1], into);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(MapFuse, AddsTheSightings) {
  Map map = MakeMap(1);
  const LandmarkId from = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const LandmarkId into = map.AddLandmark(kPoint, KeyframeId(0), 1);
  map.CountSightings(from, 4, 2);
  map.Fuse(from, into);
  EXPECT_EQ(map.GetLandmark(into).visible_count, 6);
  EXPECT_EQ(map.GetLandmark(into).found_count, 4);
}

TEST(MapFuse, NamesAreFollowedThroughAChain) {
  Map map = MakeMap(1);
  std::vector<LandmarkId> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(map.AddLandmark(kPoint, KeyframeId(0), i));
  for (int i = 0; i < 3; ++i) map.Fuse(ids[i], ids[i + 1]);
  const auto snapshot = map.Snapshot();
  for (const LandmarkId id : ids) {
    EXPECT_EQ(map.FindLandmark(id)->id, ids[3]);
    EXPECT_EQ(snapshot->FindLandmark(id)->id, ids[3]);
  }
  map.RemoveLandmark(ids[3]);
  for (const LandmarkId id : ids) EXPECT_EQ(map.FindLandmark(id), nullptr);
  EXPECT_EQ(FindProblem(map), "");
}

TEST(MapFuse, RefusesTheSameLandmarkAndOneThatIsGone) {
  Map map = MakeMap(1);
  const LandmarkId a = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const LandmarkId gone = map.AddLandmark(kPoint, KeyframeId(0), 1);
  map.RemoveLandmark(gone);
  EXPECT_THROW(map.Fuse(a, a), std::logic_error);
  EXPECT_THROW(map.Fuse(gone, a), std::logic_error);
  EXPECT_THROW(map.Fuse(a, gone), std::logic_error);
  EXPECT_NE(map.FindLandmark(a), nullptr) << "a refusal leaves the map as it was";
  EXPECT_EQ(FindProblem(map), "");
}

TEST(MapRefreshLandmark, MeanViewIsTheUnitMeanOfTheViews) {
  Map map(test::TestScales());
  for (const double x : {-2.0, 2.0}) map.AddKeyframe(MakePlainKeyframe(1, CameraAt(x, 0, 0)));
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const float half = std::sqrt(0.5F);
  EXPECT_LT((map.GetLandmark(id).mean_view - Eigen::Vector3f(half, 0, half)).norm(), 1e-6);
  map.AddObservation(id, KeyframeId(1), 0);
  map.RefreshLandmark(id);
  EXPECT_LT((map.GetLandmark(id).mean_view - Eigen::Vector3f(0, 0, 1)).norm(), 1e-6);
}

TEST(MapRefreshLandmark, DistanceRangeIsThatOfTheFirstObserversPyramid) {
  Map map(test::TestScales());
  map.AddKeyframe(MakeTestKeyframe(MakeTestFeatures({{{320, 240}, 2, 3, {}, 0}})));
  map.AddKeyframe(MakePlainKeyframe(1, CameraAt(0, 0, -3)));
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 0);
  map.AddObservation(id, KeyframeId(1), 0);
  map.RefreshLandmark(id);
  const double max_distance = 2 * std::pow(1.2, 3);
  EXPECT_NEAR(map.GetLandmark(id).max_distance_m, max_distance, 1e-5);
  EXPECT_NEAR(map.GetLandmark(id).min_distance_m, max_distance / std::pow(1.2, 7), 1e-5);
}

TEST(MapRefreshLandmark, TakesTheDescriptorNearestToTheOthers) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  const Descriptor typical = test::RandomDescriptor(engine);
  Map map(test::TestScales());
  const std::vector<Descriptor> seen = {FlipBits(typical, 120), FlipBits(typical, 10, 200), typical,
                                        FlipBits(typical, 12, 180), FlipBits(typical, 11, 150)};
  for (const Descriptor& d : seen) {
    map.AddKeyframe(MakeTestKeyframe(MakeTestFeatures({{{320, 240}, 2, 0, d, 0}})));
  }
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 0);
  EXPECT_EQ(map.GetLandmark(id).descriptor, seen[0]) << "the only one";
  for (int i = 1; i < 5; ++i) map.AddObservation(id, KeyframeId(i), 0);
  map.RefreshLandmark(id);
  EXPECT_EQ(map.GetLandmark(id).descriptor, typical);
}

TEST(MapRefreshLandmark, TakesATypicalDescriptorOfALandmarkSeenVeryOften) {
  // Each third sighting is another thing's; of the rest each is 5 bits off, at places of its own.
  RandomEngine engine = MakeRandomEngine(1, 0);
  const Descriptor typical = test::RandomDescriptor(engine);
  constexpr int kSightings = 300;
  Map map(test::TestScales());
  for (int i = 0; i < kSightings; ++i) {
    const Descriptor d =
        i % 3 == 0 ? test::RandomDescriptor(engine) : FlipBits(typical, 5, i % 50 * 5);
    map.AddKeyframe(MakeTestKeyframe(MakeTestFeatures({{{320, 240}, 2, 0, d, 0}})));
  }
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 0);
  for (int i = 1; i < kSightings; ++i) map.AddObservation(id, KeyframeId(i), 0);
  map.RefreshLandmark(id);
  EXPECT_EQ(HammingDistance(map.GetLandmark(id).descriptor, typical), 5);
}

TEST(MapCountSightings, AddsToBothCountsAlsoByAReplacedName) {
  Map map = MakeMap(1);
  const LandmarkId old_name = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 1);
  map.Fuse(old_name, id);
  map.CountSightings(id, 3, 1);
  map.CountSightings(old_name, 1, 0);
  EXPECT_EQ(map.GetLandmark(id).visible_count, 2 + 4);
  EXPECT_EQ(map.GetLandmark(id).found_count, 2 + 1);
}

TEST(MapCountSightings, IgnoresLandmarksThatAreGone) {
  Map map = MakeMap(1);
  const LandmarkId gone = map.AddLandmark(kPoint, KeyframeId(0), 0);
  map.RemoveLandmark(gone);
  EXPECT_NO_THROW(map.CountSightings(gone, 1, 1));
  EXPECT_NO_THROW(map.CountSightings(LandmarkId(), 1, 1));
  EXPECT_EQ(map.landmarks().size(), 0U);
}

/// A keyframe of four features of these static probabilities.
Keyframe KeyframeOfProbabilities(const std::vector<float>& probabilities) {
  FrameFeatures features = *MakeTestFeatures(std::vector<test::TestFeature>(probabilities.size()));
  features.static_probability = probabilities;
  return MakeTestKeyframe(std::make_shared<const FrameFeatures>(features));
}

TEST(MapStaticProbability, BeginsAsThatOfTheFeature) {
  Map map(test::TestScales());
  map.AddKeyframe(KeyframeOfProbabilities({1, 0.25F}));
  map.AddKeyframe(MakePlainKeyframe(1));
  EXPECT_EQ(map.GetLandmark(map.AddLandmark(kPoint, KeyframeId(0), 1)).static_probability, 0.25F);
  EXPECT_EQ(map.GetLandmark(map.AddLandmark(kPoint, KeyframeId(1), 0)).static_probability, 1)
      << "nothing else is told";
}

TEST(MapStaticProbability, MovesTowardsWhatIsSeen) {
  Map map = MakeMap(1);
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const auto probability = [&] { return map.GetLandmark(id).static_probability; };
  float before = probability();
  for (int i = 0; i < 12; ++i) {
    map.UpdateStaticProbability(id, 0);
    EXPECT_LT(probability(), before);
    before = probability();
  }
  EXPECT_LT(probability(), 0.3);
  EXPECT_GT(probability(), 0.2) << "no single frame decides";
  for (int i = 0; i < 40; ++i) map.UpdateStaticProbability(id, 0.8F);
  EXPECT_NEAR(probability(), 0.8, 0.02);
  EXPECT_LE(probability(), 0.8F) << "never beyond what is seen";
}

TEST(MapStaticProbability, IsUpdatedByAReplacedNameToo) {
  Map map = MakeMap(1);
  const LandmarkId old_name = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 1);
  map.Fuse(old_name, id);
  map.UpdateStaticProbability(old_name, 0);
  EXPECT_LT(map.GetLandmark(id).static_probability, 1);
}

TEST(MapStaticProbability, LandmarksThatAreGoneAreIgnored) {
  Map map = MakeMap(1);
  const LandmarkId gone = map.AddLandmark(kPoint, KeyframeId(0), 0);
  map.RemoveLandmark(gone);
  EXPECT_NO_THROW(map.UpdateStaticProbability(gone, 0));
  EXPECT_NO_THROW(map.UpdateStaticProbability(LandmarkId(), 0));
  EXPECT_EQ(map.landmarks().size(), 0U);
}

TEST(MapStaticProbability, SnapshotsKeepWhatTheyHad) {
  Map map = MakeMap(1);
  const LandmarkId id = map.AddLandmark(kPoint, KeyframeId(0), 0);
  const auto snapshot = map.Snapshot();
  map.UpdateStaticProbability(id, 0);
  EXPECT_EQ(snapshot->landmarks.Find(id)->static_probability, 1);
}

}  // namespace
}  // namespace ofm
