#include "ofm/geometry/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace ofm {
namespace {

constexpr double kDegree = M_PI / 180;

Ray RayTo(const Eigen::Vector3d& origin, const Eigen::Vector3d& point) {
  return {origin, point - origin};
}

TEST(TriangulateRays, TwoRaysMeetInThePoint) {
  const Eigen::Vector3d point(0.3, -0.2, 4);
  const std::vector rays{RayTo({0, 0, 0}, point), RayTo({0.5, 0.1, 0.2}, point)};
  const auto result = TriangulateRays(rays, kDegree);
  ASSERT_TRUE(result);
  EXPECT_LT((result->point_in_world - point).norm(), 1e-12);
  EXPECT_LT(result->max_distance_m, 1e-12);
}

TEST(TriangulateRays, RaysOfCamerasAgreeWithTheirProjections) {
  const Eigen::Vector3d point(0.3, -0.2, 4);
  std::vector<Ray> rays;
  for (int i = 0; i < 4; ++i) {
    const RigidTransform camera_from_world(ExpSo3(Eigen::Vector3d(0.1 * i, -0.05, 0.3)),
                                           Eigen::Vector3d(0.2 * i, 0.1, -0.3));
    const Eigen::Vector3d in_camera = camera_from_world * point;
    rays.push_back(Ray::FromCamera(camera_from_world, in_camera.hnormalized()));
  }
  const auto result = TriangulateRays(rays, kDegree);
  ASSERT_TRUE(result);
  EXPECT_LT((result->point_in_world - point).norm(), 1e-12);
}

TEST(TriangulateRays, SkewRaysGiveTheMiddleOfTheShortestLineBetweenThem) {
  // One along x at z = 1, one along y at z = 3: closest above (5, 7).
  const std::vector<Ray> rays{{{0, 7, 1}, {2, 0, 0}}, {{5, 0, 3}, {0, 0.1, 0}}};
  const auto result = TriangulateRays(rays, kDegree);
  ASSERT_TRUE(result);
  EXPECT_LT((result->point_in_world - Eigen::Vector3d(5, 7, 2)).norm(), 1e-12);
  EXPECT_NEAR(result->max_distance_m, 1, 1e-12);
  EXPECT_NEAR(result->parallax_rad, 90 * kDegree, 1e-12);
}

TEST(TriangulateRays, ParallaxIsTheLargestAngleBetweenTwoRays) {
  const Eigen::Vector3d point(0, 0, 1);
  const auto origin_at = [&](double angle_rad) {
    return Eigen::Vector3d(std::tan(angle_rad), 0, 0);
  };
  const std::vector rays{RayTo(origin_at(2 * kDegree), point), RayTo(origin_at(0), point),
                         RayTo(origin_at(-3 * kDegree), point)};
  const auto result = TriangulateRays(rays, kDegree);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->parallax_rad, 5 * kDegree, 1e-12);
}

TEST(TriangulateRays, TooLittleParallaxGivesNothing) {
  const Eigen::Vector3d point(0, 0, 10);
  const std::vector rays{RayTo({0, 0, 0}, point), RayTo({0.1, 0, 0}, point)};  // 0.57 degrees
  EXPECT_FALSE(TriangulateRays(rays, kDegree));
  EXPECT_TRUE(TriangulateRays(rays, 0.5 * kDegree));
}

TEST(TriangulateRays, ParallelRaysGiveNothing) {
  const std::vector<Ray> along{{{0, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 0, 1}}};
  EXPECT_FALSE(TriangulateRays(along, 1e-3));
  const std::vector<Ray> against{{{0, 0, 0}, {0, 0, 1}}, {{1, 0, 5}, {0, 0, -1}}};
  EXPECT_FALSE(TriangulateRays(against, 1e-3));
}

TEST(TriangulateRays, APointBehindACameraIsNothing) {
  const Eigen::Vector3d point(0.3, -0.2, 4);
  Ray backwards = RayTo({0.5, 0.1, 0.2}, point);
  backwards.direction *= -1;
  EXPECT_FALSE(TriangulateRays(std::vector{RayTo({0, 0, 0}, point), backwards}, kDegree));
}

TEST(TriangulateRays, FarFromTheOriginNothingIsLost) {
  const Eigen::Vector3d far(1e6, -2e6, 3e6), point = far + Eigen::Vector3d(0, 0, 3);
  const std::vector rays{RayTo(far, point), RayTo(far + Eigen::Vector3d(0.5, 0, 0), point)};
  const auto result = TriangulateRays(rays, kDegree);
  ASSERT_TRUE(result);
  EXPECT_LT((result->point_in_world - point).norm(), 1e-8);
}

TEST(TriangulateRays, NumbersThatAreNoneGiveNothing) {
  const Eigen::Vector3d point(0, 0, 1);
  std::vector rays{RayTo({0, 0, 0}, point), RayTo({0.5, 0, 0}, point)};
  rays[1].direction.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(TriangulateRays(rays, kDegree));
}

TEST(TriangulateRays, OneRayIsTheProgrammersFault) {
  EXPECT_THROW(TriangulateRays(std::vector<Ray>(1), kDegree), std::logic_error);
}

}  // namespace
}  // namespace ofm
