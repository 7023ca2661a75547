#include "ofm/sim/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>

#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

SimSequenceOptions Options(SceneKind scene, PeopleKind people) {
  SimSequenceOptions options;
  options.camera = MakeSimCamera(80, 60);
  options.world.scene = scene;
  options.world.people = people;
  options.frames = 90;
  return options;
}

int CountClass(const Scene& scene, const std::string& name) {
  const auto& names = scene.class_names();
  return static_cast<int>(std::count(names.begin(), names.end(), name));
}

class FurnishedWorld : public testing::TestWithParam<SceneKind> {};

TEST_P(FurnishedWorld, WithoutPeopleNothingMovesAndTheViewIsFull) {
  const SimSequence sequence(Options(GetParam(), PeopleKind::kNone));
  EXPECT_EQ(sequence.scene().mover_count(), 0U);
  EXPECT_GE(CountClass(sequence.scene(), "chair"), 2);
  EXPECT_GE(CountClass(sequence.scene(), "tv"), 2);
  const SimFrame frame = sequence.Render(FrameId(0));
  EXPECT_EQ(cv::countNonZero(frame.frame.depth_m), 80 * 60);
  const double mean = cv::mean(frame.frame.gray)[0];
  EXPECT_GT(mean, 60);
  EXPECT_LT(mean, 170);
}

TEST_P(FurnishedWorld, WalkersMoveAndStayOutOfTheCamera) {
  const SimSequence sequence(Options(GetParam(), PeopleKind::kWalking));
  const Scene& scene = sequence.scene();
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

TEST_P(FurnishedWorld, TourSeesSolidsAllTheWay) {
  SimSequenceOptions options = Options(GetParam(), PeopleKind::kNone);
  options.path.kind = CameraPathKind::kTour;
  options.rate_hz = 0.7;
  options.frames = 24;
  const SimSequence sequence(options);
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

TEST(World, SittersStayAtTheirDesks) {
  const SimSequence sequence(Options(SceneKind::kOffice, PeopleKind::kSitting));
  EXPECT_EQ(CountClass(sequence.scene(), "person"), 2);
  for (const Body& body : sequence.scene().bodies()) {
    if (body.class_name != "person") continue;
    const Eigen::Vector3d start = WorldFromBody(body.motion, 0).translation();
    EXPECT_EQ(WorldFromBody(body.motion, 5).translation(), start);
    EXPECT_GT(
        (WorldFromParts(body, 1)[14].translation() - WorldFromParts(body, 2)[14].translation())
            .norm(),
        1e-3)
        << "hands move";
  }
}

TEST(World, PeopleDoNotChangeTheFurniture) {
  const Scene a = MakeWorld({{SceneKind::kOffice, PeopleKind::kNone}, {}, {}});
  const Scene b = MakeWorld({{SceneKind::kOffice, PeopleKind::kWalking}, {}, {}});
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
