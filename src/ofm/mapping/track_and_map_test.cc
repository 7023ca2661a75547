// Tracker and mapper together on the made world.
#include <gtest/gtest.h>

#include "ofm/mapping/mapper.h"
#include "ofm/mapping/test_mapping.h"
#include "ofm/tracking/tracker.h"

namespace ofm {
namespace {

using test::FeatureWorld;
using test::FeatureWorldOptions;
using test::FindProblem;
using test::MadeFrame;

FeatureWorldOptions NoisyWorld() {
  FeatureWorldOptions options = test::DefaultWorld();
  options.landmarks.path.kind = CameraPathKind::kHalfsphere;
  options.landmarks.frames = 41;
  options.pixel_sigma = 0.5;
  options.depth_sigma = 1.4e-3;
  options.depthless_share = 0.2;
  options.descriptor_noise_bits = 8;
  return options;
}

/// What came of a run.
struct Outcome {
  std::vector<RigidTransform> poses, truth;  // camera_from_world, from the second frame on
  std::shared_ptr<const MapSnapshot> map;
  std::string problem;  // the map's, when it first had one
  int lost = 0;

  double RmsError_m() const {
    double sum = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double error = test::DistanceOfCentres_m(poses[i], truth[i]);
      sum += error * error;
    }
    return std::sqrt(sum / static_cast<double>(poses.size()));
  }
};

Outcome RunOn(const FeatureWorldOptions& options, std::uint32_t frames) {
  const FeatureWorld world(options);
  Tracker tracker(world.model(), {}, 1);
  Mapper mapper(world.model(), {});
  Outcome outcome;
  std::vector<Sighting> sightings;
  const RigidTransform world_from_first = world.Frame(0).camera_from_world.Inverse();
  for (std::uint32_t i = 0; i < frames; ++i) {
    const MadeFrame frame = world.Frame(i);
    const TrackingResult result = tracker.Process(MakeInput(frame, mapper.Snapshot()));
    outcome.lost += !HasPose(result.status);
    sightings.insert(sightings.end(), result.sightings.begin(), result.sightings.end());
    if (result.keyframe) {
      mapper.Insert(*result.keyframe, sightings);
      sightings.clear();
      mapper.Refine();
      if (outcome.problem.empty()) outcome.problem = FindProblem(mapper.map());
    }
    if (i == 0) continue;
    outcome.poses.push_back(result.camera_from_world);
    outcome.truth.push_back(frame.camera_from_world * world_from_first);
  }
  mapper.AdjustAll();
  outcome.map = mapper.Snapshot();
  return outcome;
}

TEST(TrackAndMap, FollowTheCameraAndKeepTheMapConsistent) {
  const Outcome outcome = RunOn(NoisyWorld(), 40);
  EXPECT_EQ(outcome.lost, 0);
  EXPECT_EQ(outcome.problem, "");
  EXPECT_EQ(FindProblem(*outcome.map), "");
  EXPECT_LT(outcome.RmsError_m(), 0.01);
  EXPECT_GT(outcome.map->keyframe_count, 1U);
  EXPECT_LT(outcome.map->keyframe_count, 40U);
}

TEST(TrackAndMap, LandmarksAreThePointsOfTheWorldAndNoneIsThereTwice) {
  const FeatureWorldOptions options = NoisyWorld();
  const FeatureWorld world(options);
  const Outcome outcome = RunOn(options, 40);
  const RigidTransform first_from_world = world.Frame(0).camera_from_world;
  std::vector<MadeFrame> frames;
  for (std::uint32_t i = 0; i < 40; ++i) frames.push_back(world.Frame(i));
  int good = 0, all = 0;
  std::map<std::uint32_t, int> landmarks_of;  // by the world's point
  outcome.map->landmarks.ForEach([&](const Landmark& landmark) {
    ++all;
    const Landmark::Observation& o = landmark.observations.front();
    const FrameId frame = outcome.map->keyframes.Find(o.keyframe)->frame_id;
    const LandmarkId shown = frames[frame.value].shown[o.feature];
    const Eigen::Vector3d truth = first_from_world * world.points()[shown.value];
    good += (landmark.position_in_world - truth).norm() < 0.05;
    ++landmarks_of[shown.value];
  });
  EXPECT_GT(all, 400);
  EXPECT_GT(good, 0.9 * all);
  EXPECT_LT(all, 1.1 * static_cast<double>(landmarks_of.size()));
}

TEST(TrackAndMap, GiveTheSameBytesEveryTime) {
  const Outcome a = RunOn(NoisyWorld(), 20), b = RunOn(NoisyWorld(), 20);
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].translation(), b.poses[i].translation());
    EXPECT_EQ(a.poses[i].rotation().coeffs(), b.poses[i].rotation().coeffs());
  }
  ASSERT_EQ(a.map->landmark_count, b.map->landmark_count);
  ASSERT_EQ(a.map->keyframe_count, b.map->keyframe_count);
  a.map->landmarks.ForEach([&](const Landmark& landmark) {
    const Landmark* other = b.map->landmarks.Find(landmark.id);
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(landmark.position_in_world, other->position_in_world);
    EXPECT_EQ(landmark.descriptor, other->descriptor);
  });
}

}  // namespace
}  // namespace ofm
