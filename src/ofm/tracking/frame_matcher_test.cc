#include "ofm/tracking/frame_matcher.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "ofm/tracking/test_world.h"

namespace ofm {
namespace {

using test::FeatureWorld;
using test::MadeFrame;

/// A map of some frames of the made world at their true poses.
class FrameMatcher : public testing::Test {
 protected:
  KeyframeId Add(std::uint32_t frame_id) {
    const MadeFrame frame = world_.Frame(frame_id);
    std::vector<LandmarkId> landmarks;
    for (const LandmarkId shown : frame.shown) {
      const auto known = landmark_of_.find(shown);
      landmarks.push_back(known == landmark_of_.end() ? LandmarkId() : known->second);
    }
    const KeyframeId id =
        test::AddWithDepth(map_, world_.model(), frame, frame.camera_from_world, landmarks);
    for (std::size_t i = 0; i < frame.shown.size(); ++i) {
      landmark_of_[frame.shown[i]] = map_.GetKeyframe(id).landmarks[i];
    }
    return id;
  }

  /// Frame `id` as if it had been tracked rightly.
  TrackedFrame Tracked(std::uint32_t id) const {
    const MadeFrame frame = world_.Frame(id);
    TrackedFrame tracked{frame.id, frame.stamp_ns, frame.features, {}, frame.camera_from_world};
    for (const LandmarkId shown : frame.shown) {
      const auto known = landmark_of_.find(shown);
      tracked.landmarks.push_back(known == landmark_of_.end() ? LandmarkId() : known->second);
    }
    return tracked;
  }

  std::vector<PointMatch> MatchLast(const TrackedFrame& last, const MadeFrame& frame,
                                    double radius_px = 15) {
    return MatchLastFrame(world_.model(), options_, *map_.Snapshot(), last,
                          {*frame.features, frame.camera_from_world}, radius_px);
  }
  LocalMapMatches MatchLocal(const MadeFrame& frame, const std::vector<PointMatch>& known) {
    return MatchLocalMap(world_.model(), options_, *map_.Snapshot(),
                         {*frame.features, frame.camera_from_world}, known);
  }

  /// How many matches name another landmark than the feature shows.
  int CountWrong(const MadeFrame& frame, const std::vector<PointMatch>& matches) const {
    int wrong = 0;
    for (const PointMatch& match : matches) {
      const Eigen::Vector3d truth = world_.points()[frame.shown[match.feature].value];
      wrong += (match.point_in_world - truth).norm() > 0.01;
      if (match.landmark.valid()) {
        wrong += landmark_of_.at(frame.shown[match.feature]) != match.landmark;
      }
    }
    return wrong;
  }
  int CountKnown(const MadeFrame& frame) const {
    int known = 0;
    for (const LandmarkId shown : frame.shown) known += landmark_of_.contains(shown);
    return known;
  }

  FeatureWorld world_;
  TrackingOptions options_;
  Map map_{test::TestScales()};
  std::map<LandmarkId, LandmarkId> landmark_of_;  // by the world's
};

std::size_t CountFeatures(const std::vector<PointMatch>& matches) {
  std::set<int> features;
  for (const PointMatch& match : matches) features.insert(match.feature);
  return features.size();
}

TEST_F(FrameMatcher, LastFramesLandmarksAreFoundInTheNext) {
  Add(0);
  const MadeFrame frame = world_.Frame(1);
  const auto matches = MatchLast(Tracked(0), frame);
  EXPECT_GT(matches.size(), 0.9 * CountKnown(frame));
  EXPECT_EQ(CountWrong(frame, matches), 0);
  EXPECT_EQ(CountFeatures(matches), matches.size()) << "no feature twice";
}

TEST_F(FrameMatcher, CloseFeaturesOfTheLastFrameServeWithoutLandmark) {
  Add(0);
  TrackedFrame last = Tracked(0);
  std::fill(last.landmarks.begin(), last.landmarks.end(), LandmarkId());
  const MadeFrame frame = world_.Frame(1);
  const auto matches = MatchLast(last, frame);
  EXPECT_GT(matches.size(), 50U);
  EXPECT_EQ(CountWrong(frame, matches), 0);
  for (const PointMatch& match : matches) {
    EXPECT_FALSE(match.landmark.valid());
    EXPECT_LE((last.camera_from_world * match.point_in_world).z(),
              world_.model().CloseDepth() + 1e-5);
  }
}

TEST_F(FrameMatcher, LandmarksThatAreGoneAreNotNamed) {
  const KeyframeId keyframe = Add(0);
  const TrackedFrame last = Tracked(0);
  const std::vector<LandmarkId> landmarks = map_.GetKeyframe(keyframe).landmarks;
  for (const LandmarkId id : landmarks) map_.RemoveLandmark(id);
  const auto matches = MatchLast(last, world_.Frame(1));
  EXPECT_GT(matches.size(), 50U) << "by close depth";
  for (const PointMatch& match : matches) EXPECT_FALSE(match.landmark.valid());
}

TEST_F(FrameMatcher, LastFramesSearchIsWithinTheRadius) {
  Add(0);
  const TrackedFrame last = Tracked(0);
  MadeFrame frame = world_.Frame(0);
  frame.camera_from_world = ExpSe3((Vector6d() << 0, 0, 0, 0, 0.06, 0).finished()) *
                            frame.camera_from_world;  // 30 px off
  EXPECT_LT(MatchLast(last, frame, 4).size(), 20U);
  EXPECT_GT(MatchLast(last, frame, 40).size(), 0.8 * CountKnown(frame));
}

TEST_F(FrameMatcher, UnlikeDescriptorsAreNoMatch) {
  Add(0);
  TrackedFrame last = Tracked(0);
  auto changed = std::make_shared<FrameFeatures>(*last.features);
  for (Descriptor& d : changed->descriptors) d = test::FlipBits(d, 30);
  last.features = changed;
  options_.max_hamming = 29;
  EXPECT_TRUE(MatchLast(last, world_.Frame(0)).empty());
  options_.max_hamming = 30;
  EXPECT_GT(MatchLast(last, world_.Frame(0)).size(), 0.9 * last.features->size());
}

TEST_F(FrameMatcher, AmbiguousFeatureIsNoMatch) {
  Add(0);
  const TrackedFrame last = Tracked(0);
  const std::size_t before = MatchLast(last, world_.Frame(0)).size();
  MadeFrame frame = world_.Frame(0);
  auto changed = std::make_shared<FrameFeatures>(*frame.features);
  // Feature 7 has a twin that is as near.
  changed->keypoints.push_back(changed->keypoints[7]);
  changed->descriptors.push_back(changed->descriptors[7]);
  changed->ideal_px.push_back(changed->ideal_px[7] + Eigen::Vector2f(1, 0));
  changed->depth_m.push_back(changed->depth_m[7]);
  changed->descriptors[7] = test::FlipBits(changed->descriptors[7], 40);
  changed->descriptors.back() = test::FlipBits(changed->descriptors.back(), 40, 100);
  changed->grid = FeatureGrid(changed->ideal_px, 640, 480);
  frame.features = changed;
  const auto matches = MatchLast(last, frame);
  EXPECT_EQ(matches.size(), before - 1);
  for (const PointMatch& match : matches) EXPECT_NE(match.feature, 7);
}

TEST_F(FrameMatcher, FeatureThatTurnedOtherwiseIsDropped) {
  Add(0);
  const TrackedFrame last = Tracked(0);
  MadeFrame frame = world_.Frame(0);
  auto turned = std::make_shared<FrameFeatures>(*frame.features);
  for (Keypoint& keypoint : turned->keypoints) keypoint.angle_rad += 0.3F;
  turned->keypoints[7].angle_rad += 1.5F;
  frame.features = turned;
  const auto matches = MatchLast(last, frame);
  EXPECT_GT(matches.size(), 0.9 * CountKnown(frame));
  for (const PointMatch& match : matches) EXPECT_NE(match.feature, 7);
}

TEST_F(FrameMatcher, FusedLandmarkIsMatchedOnceByItsNewName) {
  const KeyframeId keyframe = Add(0);
  const TrackedFrame last = Tracked(0);
  const std::vector<LandmarkId> landmarks = map_.GetKeyframe(keyframe).landmarks;
  // Two features of the last frame whose landmarks mapping found to be one.
  map_.SetLandmarkPosition(landmarks[3], map_.GetLandmark(landmarks[4]).position_in_world);
  map_.Fuse(landmarks[3], landmarks[4]);
  int named = 0;
  for (const PointMatch& match : MatchLast(last, world_.Frame(0), 1000)) {
    EXPECT_NE(match.landmark, landmarks[3]);
    named += match.landmark == landmarks[4];
  }
  EXPECT_EQ(named, 1);
}

TEST_F(FrameMatcher, LocalMapGivesTheLandmarksThatTheLastFrameDidNot) {
  Add(0);
  const MadeFrame frame = world_.Frame(2);
  auto known = MatchLast(Tracked(0), frame);
  known.resize(40);
  const LocalMapMatches local = MatchLocal(frame, known);
  EXPECT_EQ(local.reference, KeyframeId(0));
  EXPECT_GT(local.matches.size() + known.size(), 0.9 * CountKnown(frame));
  EXPECT_EQ(CountWrong(frame, local.matches), 0);
  auto all = known;
  all.insert(all.end(), local.matches.begin(), local.matches.end());
  EXPECT_EQ(CountFeatures(all), all.size()) << "no feature twice";
  std::set<LandmarkId> names;
  for (const PointMatch& match : all) names.insert(match.landmark);
  EXPECT_EQ(names.size(), all.size()) << "no landmark twice";
}

TEST_F(FrameMatcher, VisibleLandmarksAreThoseInViewButNotKnown) {
  Add(0);
  const MadeFrame frame = world_.Frame(2);
  auto known = MatchLast(Tracked(0), frame);
  known.resize(40);
  const LocalMapMatches local = MatchLocal(frame, known);
  const std::set<LandmarkId> visible(local.visible.begin(), local.visible.end());
  EXPECT_EQ(visible.size(), local.visible.size()) << "each once";
  for (const PointMatch& match : known) EXPECT_FALSE(visible.contains(match.landmark));
  for (const PointMatch& match : local.matches) EXPECT_TRUE(visible.contains(match.landmark));
  for (const LandmarkId id : visible) {
    const Eigen::Vector3d point = frame.camera_from_world * map_.GetLandmark(id).position_in_world;
    EXPECT_TRUE(world_.model().camera.IsInImage(world_.model().camera.ProjectIdeal(point)));
  }
}

TEST_F(FrameMatcher, LocalMapWithoutKnownLandmarksIsEmpty) {
  Add(0);
  const LocalMapMatches local = MatchLocal(world_.Frame(0), {});
  EXPECT_FALSE(local.reference.valid());
  EXPECT_TRUE(local.matches.empty());
  EXPECT_TRUE(local.visible.empty());
}

TEST_F(FrameMatcher, ReferenceIsTheKeyframeThatSharesMostLandmarks) {
  Add(0);
  Add(12);
  const MadeFrame frame = world_.Frame(12);
  std::vector<PointMatch> known;
  for (const PointMatch& match : MatchLast(Tracked(12), frame)) {
    if (map_.GetLandmark(match.landmark).FeatureIn(KeyframeId(0)) >= 0) known.push_back(match);
  }
  ASSERT_GT(known.size(), 100U);
  known.resize(100);
  const LocalMapMatches both = MatchLocal(frame, known);
  int only_second = 0;
  for (const PointMatch& match : both.matches) {
    only_second += map_.GetLandmark(match.landmark).FeatureIn(KeyframeId(0)) < 0;
  }
  EXPECT_GT(only_second, 10);
  options_.max_local_keyframes = 1;
  const LocalMapMatches one = MatchLocal(frame, known);
  EXPECT_EQ(one.reference, KeyframeId(0)) << "equal counts: the older";
  EXPECT_LT(one.visible.size(), both.visible.size());
  for (const PointMatch& match : both.matches) {
    if (map_.GetLandmark(match.landmark).FeatureIn(KeyframeId(0)) < 0) known.push_back(match);
  }
  EXPECT_EQ(MatchLocal(frame, known).reference, KeyframeId(1));
}

TEST_F(FrameMatcher, NeighboursOfTheObserversBelongToTheLocalMap) {
  Add(0);
  Add(12);
  const auto is_seen_by = [&](const PointMatch& match, std::uint32_t keyframe) {
    return map_.GetLandmark(match.landmark).FeatureIn(KeyframeId(keyframe)) >= 0;
  };
  const MadeFrame frame = world_.Frame(6);
  std::vector<PointMatch> known;
  for (const PointMatch& match : MatchLast(Tracked(0), frame, 60)) {
    if (!is_seen_by(match, 1)) known.push_back(match);
  }
  ASSERT_GT(known.size(), 5U);
  int only_second = 0;
  for (const PointMatch& match : MatchLocal(frame, known).matches) {
    only_second += !is_seen_by(match, 0);
  }
  EXPECT_GT(only_second, 0);
}

TEST_F(FrameMatcher, KeyframesLandmarksAreFoundByDescriptorsAlone) {
  const KeyframeId keyframe = Add(0);
  const MadeFrame frame = world_.Frame(20);
  const auto matches =
      MatchKeyframe(options_, *map_.Snapshot(), map_.GetKeyframe(keyframe), *frame.features);
  EXPECT_GT(matches.size(), 0.9 * CountKnown(frame));
  EXPECT_EQ(CountWrong(frame, matches), 0);
}

TEST_F(FrameMatcher, KeyframesFeaturesWithoutLandmarkMatchNothing) {
  const KeyframeId keyframe = Add(0);
  const std::vector<LandmarkId> landmarks = map_.GetKeyframe(keyframe).landmarks;
  for (std::size_t i = 5; i < landmarks.size(); ++i) map_.RemoveLandmark(landmarks[i]);
  const MadeFrame frame = world_.Frame(0);
  EXPECT_EQ(
      MatchKeyframe(options_, *map_.Snapshot(), map_.GetKeyframe(keyframe), *frame.features).size(),
      5U);
  const MadeFrame blind = test::MakeBlindFrame(frame);
  EXPECT_TRUE(MatchKeyframe(options_, *map_.Snapshot(), map_.GetKeyframe(keyframe), *blind.features)
                  .empty());
}

}  // namespace
}  // namespace ofm
