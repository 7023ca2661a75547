#include "ofm/dynamics/box_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "ofm/base/random.h"

namespace ofm {
namespace {

constexpr double kInterval_s = 1.0 / 30;

/// A box of 60 × 150 px that goes 200 px/s to the right and 0.9 m/s away.
BoxMeasurement BoxAt(double time_s) {
  return {cv::Rect(static_cast<int>(100 + 200 * time_s), 80, 60, 150), 1.5 + 0.9 * time_s};
}

BoxState Follow(int frames) {
  BoxState state = StartBox(BoxAt(0), {});
  for (int i = 1; i <= frames; ++i) {
    state = UpdateBox(PredictBox(state, kInterval_s, {}), BoxAt(i * kInterval_s), {});
  }
  return state;
}

TEST(BoxFilter, LearnsVelocityAndPredictsOverAGap) {
  const BoxState state = Follow(20);
  EXPECT_NEAR(state.mean(5), 200, 20);
  EXPECT_NEAR(state.mean(9), 0.9, 0.1);
  const double gap_s = 0.3;
  const BoxState ahead = PredictBox(state, gap_s, {});
  const BoxMeasurement truth = BoxAt(20 * kInterval_s + gap_s);
  EXPECT_NEAR(ahead.Box().x, truth.box.x, 8);
  EXPECT_NEAR(ahead.Box().width, 60, 4);
  EXPECT_NEAR(ahead.depth_m(), *truth.depth_m, 0.06);
}

TEST(BoxFilter, MeasurementsMakeItSurerAndTimeLessSure) {
  const BoxState state = Follow(10);
  EXPECT_LT(state.covariance(0, 0), StartBox(BoxAt(0), {}).covariance(0, 0));
  EXPECT_GT(PredictBox(state, 0.2, {}).covariance(0, 0), state.covariance(0, 0));
  EXPECT_EQ(PredictBox(state, 0, {}).mean, state.mean);
}

TEST(BoxFilter, WithoutDepthTheRestIsStillFollowed) {
  BoxState state = StartBox({BoxAt(0).box, {}}, {});
  for (int i = 1; i <= 20; ++i) {
    state = UpdateBox(PredictBox(state, kInterval_s, {}), {BoxAt(i * kInterval_s).box, {}}, {});
  }
  EXPECT_NEAR(state.mean(5), 200, 20);
  const BoxState measured = UpdateBox(state, BoxAt(20 * kInterval_s), {});
  EXPECT_NEAR(measured.depth_m(), *BoxAt(20 * kInterval_s).depth_m, 0.05);
}

TEST(BoxFilter, CovarianceStaysSymmetricAndPositive) {
  const BoxState state = Follow(300);
  EXPECT_EQ(state.covariance, state.covariance.transpose());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<BoxState::Matrix>(state.covariance).eigenvalues()(0), 0);
}

TEST(BoxFilter, GoingBackInTimeIsAProgrammersError) {
  EXPECT_THROW(PredictBox(Follow(1), -0.1, {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
