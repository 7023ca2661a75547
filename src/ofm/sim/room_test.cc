#include "ofm/sim/room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

namespace ofm {
namespace {

/// A number that changes with any part's place or texture.
double Fingerprint(const Scene& scene) {
  double sum = 0, weight = 1;
  for (const Body& body : scene.bodies()) {
    for (const Part& part : body.parts) {
      const RigidTransform place = WorldFromPart(body, part, 0.7);
      sum += weight * (place.translation().sum() + place.rotation().coeffs().sum() +
                       part.half_extent_m.sum() + 1e-6 * cv::sum(part.texture->image())[0]);
      weight *= 1.01;
    }
  }
  return sum;
}

int Count(const Scene& scene, const std::string& class_name) {
  return static_cast<int>(
      std::count(scene.class_names().begin(), scene.class_names().end(), class_name));
}

TEST(MakeRoom, SameSeedGivesTheSameRoomAndAnotherSeedAnother) {
  RoomOptions options;
  options.people = 1;
  const double room = Fingerprint(MakeRoom(options, 1));
  EXPECT_EQ(room, Fingerprint(MakeRoom(options, 1)));
  EXPECT_NE(room, Fingerprint(MakeRoom(options, 2)));
}

TEST(MakeRoom, HasTheMoversWanted) {
  RoomOptions options;
  EXPECT_EQ(MakeRoom(options, 1).mover_count(), 0U);
  options.people = 2;
  options.carried_boxes = 1;
  const Scene room = MakeRoom(options, 1);
  EXPECT_EQ(room.mover_count(), 3U);
  EXPECT_EQ(Count(room, "person"), 2);
  EXPECT_EQ(Count(room, "box"), 1);
  EXPECT_EQ(room.class_names()[1], "person");
}

TEST(MakeRoom, MoversDoNotChangeTheFurniture) {
  RoomOptions options;
  const Scene still = MakeRoom(options, 9);
  options.people = 3;
  const Scene lively = MakeRoom(options, 9);
  for (std::size_t i = 0; i < still.bodies().size(); ++i) {
    const Part& a = still.bodies()[i].parts[0];
    const Part& b = lively.bodies()[i].parts[0];
    EXPECT_EQ(a.half_extent_m, b.half_extent_m);
    EXPECT_EQ(cv::norm(a.texture->image(), b.texture->image(), cv::NORM_INF), 0);
  }
}

TEST(MakeRoom, IsFurnished) {
  const Scene room = MakeRoom({}, 1);
  EXPECT_GE(room.bodies().size(), 25U);
  for (const char* name : {"dining table", "tv", "keyboard", "chair", "sports ball"}) {
    EXPECT_EQ(Count(room, name), 1) << name;
  }
  EXPECT_GE(Count(room, "book"), 4);
}

TEST(MakeRoom, FurnitureIsInsideAndLeavesTheMiddleFree) {
  constexpr double kFreeRadius_m = 1.2;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Scene room = MakeRoom({}, seed);
    for (const Body& body : room.bodies()) {
      for (const Part& part : body.parts) {
        if (part.shape == Shape::kRectangle) continue;
        const RigidTransform place = WorldFromPart(body, part, 0);
        // Bounds of the eight corners.
        Eigen::Array3d low = Eigen::Array3d::Constant(1e9), high = -low;
        for (int k = 0; k < 8; ++k) {
          const Eigen::Vector3d sign((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
          const Eigen::Array3d corner = (place * part.half_extent_m.cwiseProduct(sign)).array();
          low = low.min(corner);
          high = high.max(corner);
        }
        EXPECT_TRUE((low >= Eigen::Array3d(-3, -2.5, -1e-9)).all()) << body.class_name;
        EXPECT_TRUE((high <= Eigen::Array3d(3, 2.5, 2.6)).all()) << body.class_name;
        const Eigen::Array2d nearest =
            Eigen::Array2d::Zero().max(low.head<2>()).min(high.head<2>());
        EXPECT_GT(nearest.matrix().norm(), kFreeRadius_m) << body.class_name << " seed " << seed;
      }
    }
  }
}

TEST(MakeRoom, ThingsThatShareATextureShowDifferentPiecesOfIt) {
  const Scene room = MakeRoom({}, 1);
  std::vector<std::pair<double, double>> offsets;
  for (const Body& body : room.bodies()) {
    for (const Part& part : body.parts) {
      offsets.emplace_back(part.texture_offset_m.x(), part.texture_offset_m.y());
    }
  }
  std::sort(offsets.begin(), offsets.end());
  EXPECT_EQ(std::adjacent_find(offsets.begin(), offsets.end()), offsets.end());
}

TEST(MakeRoom, NearestMoverPassesAtTheDistanceWanted) {
  RoomOptions options;
  options.people = 1;
  options.mover_distance_m = 0.9;
  const Scene room = MakeRoom(options, 11);
  const Body& person = room.bodies().back();
  ASSERT_EQ(person.class_name, "person");
  double left = 1e9, right = -1e9;
  for (double t = 0; t < 6; t += 0.05) {
    const Eigen::Vector3d place = WorldFromBody(person.motion, t).translation();
    EXPECT_NEAR(place.y() - room.viewpoint().eye_in_world.y(), 0.9, 0.2);
    EXPECT_NEAR(place.z(), 0, 1e-12);
    left = std::min(left, place.x());
    right = std::max(right, place.x());
  }
  EXPECT_GT(right - left, 1.1);
}

}  // namespace
}  // namespace ofm
