#include "ofm/sim/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

/// Furnishing takes a while, so that tests share worlds.
const Scene& World(SceneKind scene, PeopleKind people) {
  static std::map<std::pair<SceneKind, PeopleKind>, Scene> worlds;
  const auto found = worlds.find({scene, people});
  if (found != worlds.end()) return found->second;
  WorldPlan plan;
  plan.world = {scene, people};
  plan.furnished.duration_s = 3;
  return worlds.emplace(std::pair(scene, people), MakeWorld(plan)).first->second;
}

SimSequence Sequence(const Scene& scene, const CameraPathOptions& path, double rate_hz) {
  SimSequenceOptions options;
  options.camera = MakeSimCamera(80, 60);
  options.path = path;
  options.rate_hz = rate_hz;
  return {options, scene};
}

int CountClass(const Scene& scene, const std::string& name) {
  const auto& names = scene.class_names();
  return static_cast<int>(std::count(names.begin(), names.end(), name));
}

class FurnishedWorld : public testing::TestWithParam<SceneKind> {};

TEST_P(FurnishedWorld, WithoutPeopleNothingMovesAndTheViewIsFull) {
  const Scene& scene = World(GetParam(), PeopleKind::kNone);
  EXPECT_EQ(scene.mover_count(), 0U);
  EXPECT_GE(CountClass(scene, "chair"), 2);
  EXPECT_GE(CountClass(scene, "tv"), 2);
  const SimFrame frame = Sequence(scene, {}, 30).Render(FrameId(0));
  EXPECT_EQ(cv::countNonZero(frame.frame.depth_m), 80 * 60);
  const double mean = cv::mean(frame.frame.gray)[0];
  EXPECT_GT(mean, 50);
  EXPECT_LT(mean, 190);
}

TEST_P(FurnishedWorld, TourSeesSolidsAllTheWay) {
  CameraPathOptions path;
  path.kind = CameraPathKind::kTour;
  const SimSequence sequence = Sequence(World(GetParam(), PeopleKind::kNone), path, 0.7);
  for (std::uint32_t i = 0; i < 24; ++i) {
    const RgbdFrame frame = sequence.Frame(FrameId(i));
    EXPECT_EQ(cv::countNonZero(frame.depth_m), 80 * 60) << i;
    double nearest = 0;
    cv::minMaxLoc(frame.depth_m, &nearest);
    EXPECT_GT(nearest, 0.15) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(World, FurnishedWorld,
                         testing::Values(SceneKind::kOffice, SceneKind::kCorridor));

TEST(World, WalkersMoveAndStayOutOfTheCamera) {
  const Scene& scene = World(SceneKind::kOffice, PeopleKind::kWalking);
  EXPECT_EQ(CountClass(scene, "person"), 3);
  EXPECT_EQ(CountClass(scene, "box"), 1);
  double way_m = 0;
  for (const Body& body : scene.bodies()) {
    if (body.class_name != "person") continue;
    for (double t = 0; t < 3; t += 0.1) {
      const Eigen::Vector3d here = WorldFromBody(body.motion, t).translation();
      way_m += (WorldFromBody(body.motion, t + 0.1).translation() - here).norm();
      EXPECT_GT((here - scene.viewpoint().eye_in_world).head<2>().norm(), 0.4);
    }
  }
  EXPECT_GT(way_m, 2);
}

TEST(World, SittersStayAtTheirDesksAndMoveTheirHands) {
  constexpr std::size_t kRightForearm = 14;
  const Scene& scene = World(SceneKind::kOffice, PeopleKind::kSitting);
  EXPECT_EQ(CountClass(scene, "person"), 2);
  for (const Body& body : scene.bodies()) {
    if (body.class_name != "person") continue;
    EXPECT_EQ(WorldFromBody(body.motion, 5).translation(),
              WorldFromBody(body.motion, 0).translation());
    const Eigen::Vector3d before = WorldFromParts(body, 1)[kRightForearm].translation();
    const Eigen::Vector3d after = WorldFromParts(body, 2)[kRightForearm].translation();
    EXPECT_GT((after - before).norm(), 1e-3);
  }
}

TEST(World, PeopleDoNotChangeTheFurniture) {
  const Scene& a = World(SceneKind::kOffice, PeopleKind::kNone);
  const Scene& b = World(SceneKind::kOffice, PeopleKind::kWalking);
  for (std::size_t k = 0; k < 40; ++k) {
    EXPECT_EQ(a.bodies()[k].class_name, b.bodies()[k].class_name);
    EXPECT_EQ(WorldFromParts(a.bodies()[k], 0)[0].translation(),
              WorldFromParts(b.bodies()[k], 0)[0].translation());
  }
}

TEST(World, RoomIsTheOneItWas) {
  const Scene room = MakeRoom({}, 3);
  WorldPlan plan;
  plan.furnished.seed = 3;
  EXPECT_EQ(MakeWorld(plan).bodies().size(), room.bodies().size());
}

}  // namespace
}  // namespace ofm
