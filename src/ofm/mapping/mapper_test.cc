#include "ofm/mapping/mapper.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/features/default_vocabulary.h"
#include "ofm/features/static_words.h"
#include "ofm/mapping/test_mapping.h"

namespace ofm {
namespace {

using test::Association;
using test::FeatureWorld;
using test::FindProblem;
using test::MadeFrame;

/// A mapper that is handed frames with their true poses and all landmarks that they show.
class TrueMapping {
 public:
  explicit TrueMapping(const MappingOptions& options = {},
                       const test::FeatureWorldOptions& world = test::DefaultWorld())
      : world_(world), mapper_(world_.model(), options) {}

  KeyframeCandidate Candidate(const MadeFrame& frame) const {
    KeyframeCandidate candidate;
    candidate.frame_id = frame.id;
    candidate.stamp_ns = frame.stamp_ns;
    candidate.camera_from_world = frame.camera_from_world;
    candidate.features = frame.features;
    candidate.landmarks = association_.Names(mapper_.map(), frame);
    return candidate;
  }
  KeyframeId Insert(const MadeFrame& frame, const std::vector<Sighting>& sightings = {}) {
    const KeyframeId id = mapper_.Insert(Candidate(frame), sightings);
    association_.Learn(mapper_.map().GetKeyframe(id), frame);
    return id;
  }
  KeyframeId Insert(std::uint32_t frame_id, const std::vector<Sighting>& sightings = {}) {
    return Insert(world_.Frame(frame_id), sightings);
  }

  Mapper& mapper() { return mapper_; }
  const Map& map() const { return mapper_.map(); }
  const FeatureWorld& world() const { return world_; }

 private:
  FeatureWorld world_;
  Mapper mapper_;
  Association association_;
};

/// Options under which keyframes stay.
MappingOptions KeepKeyframes() {
  MappingOptions options;
  options.redundant_share = 1.01;
  return options;
}

TEST(Mapper, InsertMakesLandmarksOfTheDepth) {
  TrueMapping mapping;
  const MadeFrame frame = mapping.world().Frame(3);
  const KeyframeId id = mapping.Insert(frame);
  const Keyframe& keyframe = mapping.map().GetKeyframe(id);
  EXPECT_EQ(keyframe.frame_id, FrameId(3));
  EXPECT_EQ(keyframe.stamp_ns, frame.stamp_ns);
  for (std::size_t i = 0; i < frame.shown.size(); ++i) {
    if (frame.features->depth_m[i] > mapping.world().model().CloseDepth()) continue;
    ASSERT_TRUE(keyframe.landmarks[i].valid());
    const Eigen::Vector3d& truth = mapping.world().points()[frame.shown[i].value];
    const Landmark& landmark = mapping.map().GetLandmark(keyframe.landmarks[i]);
    EXPECT_LT((landmark.position_in_world - truth).norm(), 1e-5);
  }
  EXPECT_EQ(FindProblem(mapping.map()), "");
  EXPECT_EQ(FindProblem(*mapping.mapper().Snapshot()), "");
}

TEST(Mapper, InsertTellsTheWordsOfWhatStandsStill) {
  TrueMapping mapping;
  const MadeFrame frame = test::Changed(mapping.world().Frame(3), [](FrameFeatures& features) {
    features.static_probability.assign(features.size(), 1);
    for (std::size_t i = 0; i < features.size() / 2; ++i) features.static_probability[i] = 0;
  });
  const Keyframe& keyframe = mapping.map().GetKeyframe(mapping.Insert(frame));
  ASSERT_NE(keyframe.words, nullptr);
  EXPECT_EQ(*keyframe.words, StaticWords(*frame.features, DefaultVocabulary()));
  EXPECT_FALSE(keyframe.words->empty());
}

TEST(Mapper, FarDepthMakesLandmarksOnlyWhereThereAreTooFew) {
  const MadeFrame frame = FeatureWorld().Frame(0);
  const double close_m = FeatureWorld().model().CloseDepth();
  const auto count = [&](int min_close) {
    MappingOptions options;
    options.min_close_landmarks = min_close;
    TrueMapping mapping(options);
    mapping.Insert(frame);
    return static_cast<int>(mapping.map().landmarks().size());
  };
  int close = 0;
  for (const float depth : frame.features->depth_m) close += depth <= close_m;
  const int all = static_cast<int>(frame.features->size());
  ASSERT_GT(close, 50);
  ASSERT_GT(all, close + 50);
  EXPECT_EQ(count(0), close);
  EXPECT_EQ(count(close + 7), close + 7) << "the nearest of the far ones";
  EXPECT_EQ(count(100000), all);
}

TEST(Mapper, InsertKeepsTheLandmarksThatTrackingFound) {
  TrueMapping mapping;
  const KeyframeId first = mapping.Insert(0);
  const std::size_t before = mapping.map().landmarks().size();
  const MadeFrame frame = mapping.world().Frame(2);
  // Of what both frames show, the map knows what the first keyframe made landmarks of: close
  // points.
  const std::vector<LandmarkId> first_shown = mapping.world().Frame(0).shown;
  std::size_t shared = 0;
  for (std::size_t i = 0; i < first_shown.size(); ++i) {
    shared += mapping.map().GetKeyframe(first).landmarks[i].valid() &&
              std::ranges::count(frame.shown, first_shown[i]) == 1;
  }
  const KeyframeCandidate candidate = mapping.Candidate(frame);
  const KeyframeId id = mapping.mapper().Insert(candidate, {});
  const Keyframe& keyframe = mapping.map().GetKeyframe(id);
  std::size_t known = 0;
  for (std::size_t i = 0; i < candidate.landmarks.size(); ++i) {
    if (!candidate.landmarks[i].valid()) continue;
    ++known;
    EXPECT_EQ(keyframe.landmarks[i], candidate.landmarks[i]);
    EXPECT_EQ(mapping.map().GetLandmark(keyframe.landmarks[i]).observations.size(), 2U);
  }
  EXPECT_EQ(known, shared);
  EXPECT_GT(known, 100U) << "else too few for a test";
  EXPECT_LE(mapping.map().landmarks().size(), before + frame.shown.size() - known);
  EXPECT_EQ(FindProblem(mapping.map()), "");
}

TEST(Mapper, PoseIsThatRelativeToTheReference) {
  TrueMapping mapping;
  const KeyframeId first = mapping.Insert(0);
  const RigidTransform first_pose = mapping.map().GetKeyframe(first).camera_from_world;
  KeyframeCandidate candidate = mapping.Candidate(mapping.world().Frame(2));
  candidate.reference = first;
  candidate.camera_from_reference = RigidTransform(ExpSo3({0, 0.1, 0}), {0.1, 0.2, 0.3});
  const KeyframeId id = mapping.mapper().Insert(candidate, {});
  EXPECT_LT(test::MaxDifference(mapping.map().GetKeyframe(id).camera_from_world,
                                candidate.camera_from_reference * first_pose),
            1e-12);
}

TEST(Mapper, SightingsAreCounted) {
  TrueMapping mapping;
  mapping.Insert(0);
  const LandmarkId id(3);
  mapping.Insert(1, {{id, true}, {id, false}, {id, false}, {LandmarkId(99999), true}});
  EXPECT_EQ(mapping.map().GetLandmark(id).visible_count, 1 + 3);
  EXPECT_EQ(mapping.map().GetLandmark(id).found_count, 1 + 1);
}

TEST(Mapper, YoungLandmarkThatIsNotFoundIsCulled) {
  TrueMapping mapping(KeepKeyframes());
  mapping.Insert(0);
  mapping.mapper().Refine();
  const std::vector<LandmarkId> first = mapping.map().GetKeyframe(KeyframeId(0)).landmarks;
  LandmarkId bad, good;
  for (const LandmarkId id : first) {
    if (!id.valid()) continue;
    good = bad;
    bad = id;
  }
  ASSERT_TRUE(good.valid());
  std::vector<Sighting> sightings(9, {bad, false});
  sightings.insert(sightings.end(), 9, {good, true});
  // Frame 0 once more: both are seen again.
  mapping.Insert(0, sightings);
  ASSERT_NE(mapping.map().FindLandmark(bad), nullptr);
  mapping.mapper().Refine();
  EXPECT_EQ(mapping.map().FindLandmark(bad), nullptr);
  EXPECT_NE(mapping.map().FindLandmark(good), nullptr);
  EXPECT_EQ(FindProblem(mapping.map()), "");
}

TEST(Mapper, LandmarkThatOneKeyframeSeesGoesTwoKeyframesLater) {
  for (const int min_observations : {1, 2}) {
    MappingOptions options = KeepKeyframes();
    options.min_observations = min_observations;
    TrueMapping mapping(options);
    mapping.Insert(0);
    const std::size_t made = mapping.map().landmarks().size();
    for (std::uint32_t i = 1; i < 3; ++i) {
      mapping.mapper().Refine();
      EXPECT_EQ(mapping.map().landmarks().size(), made) << "too young to judge";
      mapping.Insert(test::MakeBlindFrame(mapping.world().Frame(i)));
    }
    mapping.mapper().Refine();
    EXPECT_EQ(mapping.map().landmarks().size(), min_observations == 1 ? made : 0U);
    EXPECT_EQ(FindProblem(mapping.map()), "");
  }
}

TEST(Mapper, GrownLandmarkIsNotJudgedAnyMore) {
  TrueMapping mapping(KeepKeyframes());
  for (std::uint32_t i = 0; i < 4; ++i) {
    mapping.Insert(0);
    mapping.mapper().Refine();
  }
  const LandmarkId id(3);
  ASSERT_NE(mapping.map().FindLandmark(id), nullptr);
  mapping.Insert(0, std::vector<Sighting>(50, {id, false}));
  mapping.mapper().Refine();
  EXPECT_NE(mapping.map().FindLandmark(id), nullptr);
}

TEST(Mapper, GoesOnWithAMapWhoseNewestLandmarksAreStillOnTrial) {
  TrueMapping mapping(KeepKeyframes());
  mapping.Insert(0);
  const auto saved = mapping.mapper().Snapshot();
  const KeyframeCandidate candidate = mapping.Candidate(mapping.world().Frame(1));
  Mapper second(mapping.world().model(), KeepKeyframes(), *saved);
  EXPECT_EQ(second.Insert(candidate, {}), KeyframeId(1));
  const LandmarkId bad = *std::ranges::find_if(candidate.landmarks, &LandmarkId::valid);
  second.Insert(mapping.Candidate(mapping.world().Frame(2)),
                std::vector<Sighting>(9, {bad, false}));
  ASSERT_NE(second.map().FindLandmark(bad), nullptr);
  second.Refine();
  EXPECT_EQ(second.map().FindLandmark(bad), nullptr);
  EXPECT_EQ(FindProblem(second.map()), "");
  EXPECT_EQ(FindProblem(*saved), "") << "the first map has not changed";
}

TEST(Mapper, ACandidateThatBeginsASubmapHasOneOfItsOwn) {
  TrueMapping mapping(KeepKeyframes());
  mapping.Insert(0);
  KeyframeCandidate apart = mapping.Candidate(mapping.world().Frame(1));
  apart.landmarks.assign(apart.landmarks.size(), LandmarkId());
  apart.begins_submap = true;
  const KeyframeId begun = mapping.mapper().Insert(apart, {});
  EXPECT_EQ(mapping.map().FindSubmap(begun), SubmapId(begun.value));
  for (const KeyframeId reference : {begun, KeyframeId(0)}) {
    KeyframeCandidate next = apart;
    next.begins_submap = false;
    next.reference = reference;
    const KeyframeId id = mapping.mapper().Insert(next, {});
    EXPECT_EQ(mapping.map().FindSubmap(id), mapping.map().FindSubmap(reference));
  }
}

TEST(Mapper, RefinesASubmapWithoutTheOthersWhateverTheirPlaces) {
  TrueMapping mapping;
  for (const std::uint32_t i : {0, 1, 2}) {
    mapping.Insert(i);
    mapping.mapper().Refine();
  }
  const auto before = mapping.mapper().Snapshot();
  // The same views once more, of a camera that is lost: in the same place by accident.
  Association known;
  for (const std::uint32_t i : {0, 1, 2, 3}) {
    const MadeFrame frame = mapping.world().Frame(i);
    KeyframeCandidate candidate = mapping.Candidate(frame);
    candidate.landmarks = known.Names(mapping.map(), frame);
    candidate.begins_submap = i == 0;
    candidate.reference = i == 0 ? KeyframeId() : mapping.map().latest_keyframe();
    candidate.camera_from_reference =
        frame.camera_from_world *
        mapping.world().Frame(i == 0 ? 0 : i - 1).camera_from_world.Inverse();
    known.Learn(mapping.map().GetKeyframe(mapping.mapper().Insert(candidate, {})), frame);
    mapping.mapper().Refine();
    ASSERT_EQ(FindProblem(mapping.map()), "") << i;
  }
  EXPECT_EQ(mapping.map().FindSubmap(mapping.map().latest_keyframe()), SubmapId(3));
  before->keyframes.ForEach([&](const Keyframe& keyframe) {
    EXPECT_EQ(mapping.map().GetKeyframe(keyframe.id).landmarks, keyframe.landmarks)
        << "not even landmarks on trial have gone";
  });
}

TEST(Mapper, NothingToRefineIsNoError) {
  TrueMapping mapping;
  mapping.mapper().Refine();
  mapping.mapper().AdjustAll();
  EXPECT_EQ(mapping.map().keyframes().size(), 0U);
}

TEST(Mapper, AdjustsUnlessAskedToStop) {
  std::stop_source stopped;
  stopped.request_stop();
  for (const std::stop_token& stop : {std::stop_token(), stopped.get_token()}) {
    TrueMapping mapping(KeepKeyframes());
    mapping.Insert(0);
    mapping.Insert(2);
    KeyframeCandidate off = mapping.Candidate(mapping.world().Frame(4));
    const RigidTransform truth = off.camera_from_world;
    off.camera_from_world = RigidTransform(ExpSo3({0, 0.002, 0}), {0.005, 0, 0}) * truth;
    const KeyframeId id = mapping.mapper().Insert(off, {});
    mapping.mapper().Refine(stop);
    const RigidTransform pose = mapping.map().GetKeyframe(id).camera_from_world;
    if (stop.stop_requested()) {
      EXPECT_EQ(test::MaxDifference(pose, off.camera_from_world), 0);
    } else {
      EXPECT_LT(test::DistanceOfCentres_m(pose, truth), 2e-3);
    }
    EXPECT_EQ(FindProblem(mapping.map()), "");
  }
}

TEST(Mapper, LandmarksThatAreSeenMovingGo) {
  TrueMapping mapping(KeepKeyframes());
  mapping.Insert(0);
  const LandmarkId moving(3), doubtful(4), still(5), unseen(6);
  const auto sight = [](LandmarkId id, std::optional<float> probability, std::size_t times) {
    return std::vector<Sighting>(times, Sighting{id, false, probability});
  };
  std::vector<Sighting> sightings = sight(moving, 0.0F, 20);
  for (const auto& more : {sight(doubtful, 0.0F, 5), sight(still, 1.0F, 20),
                           sight(unseen, std::nullopt, 20), sight(LandmarkId(99999), 0.0F, 20)}) {
    sightings.insert(sightings.end(), more.begin(), more.end());
  }
  mapping.Insert(1, sightings);
  EXPECT_EQ(mapping.map().FindLandmark(moving), nullptr);
  ASSERT_NE(mapping.map().FindLandmark(doubtful), nullptr);
  EXPECT_LT(mapping.map().GetLandmark(doubtful).static_probability, 0.7);
  EXPECT_EQ(mapping.map().GetLandmark(still).static_probability, 1);
  EXPECT_EQ(mapping.map().GetLandmark(unseen).static_probability, 1);
  EXPECT_EQ(FindProblem(mapping.map()), "");
}

TEST(Mapper, ProbabilityUnderWhichLandmarksGoIsThatOfTheOptions) {
  for (const double least : {0.0, 0.9}) {
    MappingOptions options = KeepKeyframes();
    options.min_static_probability = least;
    TrueMapping mapping(options);
    mapping.Insert(0);
    mapping.Insert(1, std::vector<Sighting>(3, Sighting{LandmarkId(3), false, 0.0F}));
    EXPECT_EQ(mapping.map().FindLandmark(LandmarkId(3)) == nullptr, least > 0);
  }
}

/// A landmark that tracking still names in the new keyframe is gone from it too.
TEST(Mapper, KeyframeDoesNotNameALandmarkThatJustWent) {
  TrueMapping mapping(KeepKeyframes());
  mapping.Insert(0);
  const KeyframeCandidate candidate = mapping.Candidate(mapping.world().Frame(1));
  LandmarkId named;
  for (const LandmarkId id : candidate.landmarks) named = id.valid() ? id : named;
  ASSERT_TRUE(named.valid());
  const KeyframeId id =
      mapping.mapper().Insert(candidate, std::vector<Sighting>(30, Sighting{named, true, 0.0F}));
  EXPECT_EQ(mapping.map().FindLandmark(named), nullptr);
  for (const LandmarkId seen : mapping.map().GetKeyframe(id).landmarks) EXPECT_NE(seen, named);
  EXPECT_EQ(FindProblem(mapping.map()), "");
}

}  // namespace
}  // namespace ofm
