#include "ofm/geometry/rigid_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ofm/base/random.h"

namespace ofm {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d RandomDirection(RandomEngine& engine) {
  Eigen::Vector3d v;
  do {
    for (double& x : v) x = 2 * UniformReal(engine) - 1;
  } while (v.norm() > 1 || v.norm() < 0.1);
  return v.normalized();
}

RigidTransform RandomTransform(RandomEngine& engine) {
  const double angle = (2 * UniformReal(engine) - 1) * kPi;
  return {ExpSo3(angle * RandomDirection(engine)), 3 * RandomDirection(engine)};
}

void ExpectNear(const RigidTransform& a, const RigidTransform& b, double tolerance) {
  EXPECT_LE((a.RotationMatrix() - b.RotationMatrix()).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LE((a.translation() - b.translation()).cwiseAbs().maxCoeff(), tolerance);
}

// Exp by its defining series sum (M^k / k!), with squaring: slow, and independent of the code.
Eigen::Matrix4d SeriesExp(const Vector6d& twist) {
  constexpr int kSquarings = 6;
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m.topLeftCorner<3, 3>() = SkewSymmetric(twist.tail<3>());
  m.topRightCorner<3, 1>() = twist.head<3>();
  m /= std::pow(2.0, kSquarings);
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity(), term = result;
  for (int k = 1; k < 20; ++k) {
    term = term * m / k;
    result += term;
  }
  for (int i = 0; i < kSquarings; ++i) result = result * result;
  return result;
}

// Angles around the places where the formulas change or lose digits.
const double kAngles[] = {0,    1e-300, 1e-12, 1e-8, 9.9e-7, 1.1e-6,     1e-5,       1e-4,
                          1e-3, 0.01,   0.1,   1,    3,      kPi - 1e-3, kPi - 1e-7, kPi - 1e-12};

TEST(SkewSymmetric, IsTheCrossProduct) {
  const Eigen::Vector3d a(1, -2, 3), b(0.5, 4, -1);
  EXPECT_EQ(SkewSymmetric(a) * b, a.cross(b));
}

TEST(ExpSo3, TurnsByItsNormAboutItsDirection) {
  const Eigen::Quaterniond q = ExpSo3(Eigen::Vector3d(0, 0, kPi / 2));
  EXPECT_LT((q * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(ExpSo3(Eigen::Vector3d::Zero()).coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(ExpSo3, LogIsItsInverseFromNoAngleToPi) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d omega = angle * RandomDirection(engine);
      const Eigen::Quaterniond q = ExpSo3(omega);
      EXPECT_NEAR(q.norm(), 1, 1e-15);
      EXPECT_LE((LogSo3(q) - omega).norm(), 4e-15 * angle) << "angle " << angle;
    }
  }
}

TEST(LogSo3, IsTheSameForBothQuaternionsOfARotation) {
  RandomEngine engine = MakeRandomEngine(2, 0);
  for (const double angle : {1e-9, 0.5, 3.0}) {
    const Eigen::Quaterniond q = ExpSo3(angle * RandomDirection(engine));
    const Eigen::Quaterniond minus_q(-q.coeffs());
    EXPECT_LE((LogSo3(q) - LogSo3(minus_q)).norm(), 1e-15);
  }
}

TEST(LogSo3, OfHalfATurnHasLengthPi) {
  EXPECT_DOUBLE_EQ(LogSo3(Eigen::Quaterniond(0, 0, 1, 0)).norm(), kPi);
  EXPECT_DOUBLE_EQ(LogSo3(Eigen::Quaterniond(-0.0, 0, 0, 1)).norm(), kPi);
}

TEST(ExpSe3, EqualsTheSeriesThatDefinesIt) {
  RandomEngine engine = MakeRandomEngine(3, 0);
  for (const double angle : kAngles) {
    Vector6d twist;
    twist << 2 * RandomDirection(engine), angle * RandomDirection(engine);
    const Eigen::Matrix4d expected = SeriesExp(twist);
    const RigidTransform actual = ExpSe3(twist);
    EXPECT_LE((actual.RotationMatrix() - expected.topLeftCorner<3, 3>()).norm(), 1e-13);
    EXPECT_LE((actual.translation() - expected.topRightCorner<3, 1>()).norm(), 1e-13)
        << "angle " << angle;
  }
}

TEST(ExpSe3, LogIsItsInverseFromNoAngleToPi) {
  RandomEngine engine = MakeRandomEngine(4, 0);
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      Vector6d twist;
      twist << 2 * RandomDirection(engine), angle * RandomDirection(engine);
      EXPECT_LE((LogSe3(ExpSe3(twist)) - twist).norm(), 2e-14) << "angle " << angle;
    }
  }
}

TEST(LogSe3, ExpIsItsInverse) {
  RandomEngine engine = MakeRandomEngine(5, 0);
  for (int i = 0; i < 100; ++i) {
    const RigidTransform transform = RandomTransform(engine);
    ExpectNear(ExpSe3(LogSe3(transform)), transform, 1e-13);
  }
}

TEST(RigidTransform, IsTheIdentityByDefault) {
  const Eigen::Vector3d p(1, 2, 3);
  EXPECT_EQ(RigidTransform() * p, p);
  EXPECT_EQ(RigidTransform().RotationAngle(), 0);
}

TEST(RigidTransform, TurnsThenMoves) {
  const RigidTransform t(ExpSo3(Eigen::Vector3d(0, 0, kPi / 2)), Eigen::Vector3d(10, 0, 0));
  EXPECT_LT((t * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(10, 1, 0)).norm(), 1e-14);
}

TEST(RigidTransform, NormalisesItsRotation) {
  const RigidTransform t(Eigen::Quaterniond(2, 0, 0, 2), Eigen::Vector3d::Zero());
  EXPECT_DOUBLE_EQ(t.rotation().norm(), 1);
  EXPECT_DOUBLE_EQ(t.RotationAngle(), kPi / 2);
}

TEST(RigidTransform, IsTheSameFromMatrixAndQuaternion) {
  RandomEngine engine = MakeRandomEngine(6, 0);
  const RigidTransform t = RandomTransform(engine);
  ExpectNear(RigidTransform(t.RotationMatrix(), t.translation()), t, 1e-15);
}

TEST(RigidTransform, CompositionActsFromRightToLeft) {
  RandomEngine engine = MakeRandomEngine(7, 0);
  for (int i = 0; i < 50; ++i) {
    const RigidTransform a_from_b = RandomTransform(engine), b_from_c = RandomTransform(engine);
    const Eigen::Vector3d point_in_c = RandomDirection(engine);
    const Eigen::Vector3d one_by_one = a_from_b * (b_from_c * point_in_c);
    EXPECT_LE(((a_from_b * b_from_c) * point_in_c - one_by_one).norm(), 1e-14);
  }
}

TEST(RigidTransform, CompositionIsAssociative) {
  RandomEngine engine = MakeRandomEngine(8, 0);
  const RigidTransform a = RandomTransform(engine), b = RandomTransform(engine),
                       c = RandomTransform(engine);
  ExpectNear((a * b) * c, a * (b * c), 1e-14);
}

TEST(RigidTransform, InverseUndoesIt) {
  RandomEngine engine = MakeRandomEngine(9, 0);
  for (int i = 0; i < 50; ++i) {
    const RigidTransform t = RandomTransform(engine);
    ExpectNear(t * t.Inverse(), RigidTransform(), 1e-14);
    ExpectNear(t.Inverse() * t, RigidTransform(), 1e-14);
    EXPECT_NEAR(t.Inverse().RotationAngle(), t.RotationAngle(), 1e-14);
  }
}

TEST(RigidTransform, StaysARotationOverManyCompositions) {
  const RigidTransform step(ExpSo3(Eigen::Vector3d(0.1, -0.2, 0.3)), Eigen::Vector3d::Zero());
  RigidTransform t;
  for (int i = 0; i < 10000; ++i) t = t * step;
  EXPECT_NEAR(t.RotationMatrix().determinant(), 1, 1e-14);
}

TEST(RigidTransform, RotationAngleIsFromZeroToPi) {
  for (const double angle : {0.0, 1e-9, 1.0, 3.0, kPi}) {
    const RigidTransform t(ExpSo3(Eigen::Vector3d(0, angle, 0)), Eigen::Vector3d::Zero());
    EXPECT_NEAR(t.RotationAngle(), angle, 1e-15);
  }
  const RigidTransform beyond(ExpSo3(Eigen::Vector3d(0, 4, 0)), Eigen::Vector3d::Zero());
  EXPECT_NEAR(beyond.RotationAngle(), 2 * kPi - 4, 1e-15);
}

TEST(RigidTransform, KnowsWhetherItIsFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(RigidTransform().IsFinite());
  EXPECT_FALSE(
      RigidTransform(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, nan, 0)).IsFinite());
  EXPECT_FALSE(
      RigidTransform(Eigen::Quaterniond(nan, 0, 0, 0), Eigen::Vector3d::Zero()).IsFinite());
}

TEST(Interpolate, StartsAtTheFirstAndEndsAtTheSecond) {
  RandomEngine engine = MakeRandomEngine(10, 0);
  const RigidTransform a = RandomTransform(engine), b = RandomTransform(engine);
  ExpectNear(Interpolate(a, b, 0), a, 1e-15);
  ExpectNear(Interpolate(a, b, 1), b, 1e-15);
}

TEST(Interpolate, GoesEvenlyInTranslationAndRotation) {
  const RigidTransform a;
  const RigidTransform b(ExpSo3(Eigen::Vector3d(0, 0, 1.2)), Eigen::Vector3d(4, -2, 0));
  const RigidTransform quarter = Interpolate(a, b, 0.25);
  EXPECT_LT((quarter.translation() - Eigen::Vector3d(1, -0.5, 0)).norm(), 1e-15);
  EXPECT_LT((LogSo3(quarter.rotation()) - Eigen::Vector3d(0, 0, 0.3)).norm(), 1e-15);
}

TEST(Interpolate, TakesTheShortWayWhateverTheQuaternionsSign) {
  const Eigen::Quaterniond q = ExpSo3(Eigen::Vector3d(0, 0.4, 0));
  const RigidTransform b(Eigen::Quaterniond(-q.coeffs()), Eigen::Vector3d::Zero());
  EXPECT_NEAR(Interpolate(RigidTransform(), b, 0.5).RotationAngle(), 0.2, 1e-15);
}

}  // namespace
}  // namespace ofm
