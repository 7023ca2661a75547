#include "ofm/geometry/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "ofm/base/random.h"

namespace ofm {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points MakeCloud(int count, std::uint64_t seed) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  Points points;
  for (int i = 0; i < count; ++i) {
    const double x = UniformReal(engine), y = UniformReal(engine), z = UniformReal(engine);
    points.emplace_back(4 * x - 1, 3 * y + 2, 2 * z - 5);
  }
  return points;
}

Points Moved(const RigidTransform& target_from_source, const Points& source) {
  Points target;
  for (const Eigen::Vector3d& point : source) target.push_back(target_from_source * point);
  return target;
}

RigidTransform SomeTransform() {
  return {ExpSo3(Eigen::Vector3d(0.7, -1.9, 1.1)), Eigen::Vector3d(0.3, -12, 4)};
}

void ExpectNear(const RigidTransform& actual, const RigidTransform& expected, double tolerance) {
  EXPECT_LT(LogSe3(actual * expected.Inverse()).norm(), tolerance);
}

TEST(AlignRigid, ThreePointsGiveTheTransformBack) {
  const Points source = MakeCloud(3, 1);
  const auto transform = AlignRigid(source, Moved(SomeTransform(), source));
  ASSERT_TRUE(transform);
  ExpectNear(*transform, SomeTransform(), 1e-12);
}

TEST(AlignRigid, AHalfTurnIsNoSpecialCase) {
  const Points source = MakeCloud(20, 2);
  const RigidTransform half_turn(ExpSo3(Eigen::Vector3d(0, M_PI, 0)), Eigen::Vector3d(1, 2, 3));
  const auto transform = AlignRigid(source, Moved(half_turn, source));
  ASSERT_TRUE(transform);
  EXPECT_NEAR((half_turn.Inverse() * *transform).RotationAngle(), 0, 1e-7);
}

TEST(AlignRigid, NoSmallMotionLowersTheErrorOfNoisyPoints) {
  const Points source = MakeCloud(50, 3);
  Points target = Moved(SomeTransform(), source);
  const Points noise = MakeCloud(50, 4);
  for (int i = 0; i < 50; ++i) target[i] += 0.05 * noise[i];
  const auto transform = AlignRigid(source, target);
  ASSERT_TRUE(transform);
  const auto squared_error = [&](const RigidTransform& candidate) {
    double sum = 0;
    for (int i = 0; i < 50; ++i) sum += (target[i] - candidate * source[i]).squaredNorm();
    return sum;
  };
  for (int axis = 0; axis < 6; ++axis) {
    for (const double step : {-1e-3, 1e-3}) {
      const RigidTransform other = ExpSe3(step * Vector6d::Unit(axis)) * *transform;
      EXPECT_GT(squared_error(other), squared_error(*transform));
    }
  }
}

TEST(AlignRigid, ScaleIsNotTakenUp) {
  const Points source = MakeCloud(30, 5);
  Points target;
  for (const Eigen::Vector3d& point : source) target.push_back(2 * point);
  const auto transform = AlignRigid(source, target);
  ASSERT_TRUE(transform);
  EXPECT_NEAR(transform->RotationAngle(), 0, 1e-7);
  EXPECT_NEAR(transform->RotationMatrix().determinant(), 1, 1e-12);
}

TEST(AlignRigid, MirroredPointsStillGiveARotation) {
  const Points source = MakeCloud(30, 6);
  Points target;
  for (const Eigen::Vector3d& p : source) target.emplace_back(-p.x(), p.y(), p.z());
  const auto transform = AlignRigid(source, target);
  ASSERT_TRUE(transform);
  EXPECT_NEAR(transform->RotationMatrix().determinant(), 1, 1e-12);
}

TEST(AlignRigid, PointsInOnePlaneAreEnough) {
  Points source = MakeCloud(10, 7);
  for (Eigen::Vector3d& point : source) point.z() = 1;
  const auto transform = AlignRigid(source, Moved(SomeTransform(), source));
  ASSERT_TRUE(transform);
  ExpectNear(*transform, SomeTransform(), 1e-12);
}

TEST(AlignRigid, WeightZeroIsAsIfThePointWereNotThere) {
  Points source = MakeCloud(10, 8);
  Points target = Moved(SomeTransform(), source);
  target[4] += Eigen::Vector3d(3, -2, 1);
  std::vector<double> weights(10, 0.5);
  weights[4] = 0;
  const auto transform = AlignRigid(source, target, weights);
  ASSERT_TRUE(transform);
  ExpectNear(*transform, SomeTransform(), 1e-12);
}

TEST(AlignRigid, AHeavierPointIsMetMoreClosely) {
  const Points source = MakeCloud(10, 9);
  Points target = source;
  target[0].x() += 0.1;
  std::vector<double> weights(10, 1.0);
  const auto light = AlignRigid(source, target, weights);
  weights[0] = 100;
  const auto heavy = AlignRigid(source, target, weights);
  ASSERT_TRUE(light && heavy);
  EXPECT_LT((*heavy * source[0] - target[0]).norm(), 0.5 * (*light * source[0] - target[0]).norm());
}

TEST(AlignRigid, TooFewPointsGiveNothing) {
  const Points source = MakeCloud(2, 10);
  EXPECT_FALSE(AlignRigid(source, source));
  EXPECT_FALSE(AlignRigid(Points(), Points()));
}

TEST(AlignRigid, PointsInOneLineGiveNothing) {
  Points source;
  for (int i = 0; i < 10; ++i) {
    source.push_back(Eigen::Vector3d(5, -3, 2) + 0.37 * i * Eigen::Vector3d(1, 2, -0.5));
  }
  EXPECT_FALSE(AlignRigid(source, Moved(SomeTransform(), source)));
}

TEST(AlignRigid, OnePointRepeatedGivesNothing) {
  const Points source(5, Eigen::Vector3d(0.1, 0.7, 3.3));
  EXPECT_FALSE(AlignRigid(source, Moved(SomeTransform(), source)));
}

TEST(AlignRigid, WeightsAllZeroGiveNothing) {
  const Points source = MakeCloud(5, 11);
  EXPECT_FALSE(AlignRigid(source, source, std::vector<double>(5, 0.0)));
}

TEST(AlignRigid, PointsThatAreNotFiniteGiveNothing) {
  const Points source = MakeCloud(5, 12);
  Points target = source;
  target[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(AlignRigid(source, target));
  target[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(AlignRigid(source, target));
}

TEST(AlignRigid, ListsOfDifferentLengthsAreTheProgrammersFault) {
  const Points source = MakeCloud(5, 13);
  const Points target = MakeCloud(4, 13);
  EXPECT_THROW(AlignRigid(source, target), std::logic_error);
  EXPECT_THROW(AlignRigid(source, source, std::vector<double>(4, 1.0)), std::logic_error);
  EXPECT_THROW(AlignRigid(source, source, std::vector<double>(5, -1.0)), std::logic_error);
}

}  // namespace
}  // namespace ofm
