#include "ofm/camera/depth_noise.h"

#include <gtest/gtest.h>

namespace ofm {
namespace {

TEST(DepthSigma, EqualsThePublishedErrorOfTheKinect) {
  // Khoshelham and Elberink 2012: "from a few millimetres up to about 4 cm at the maximum range".
  EXPECT_NEAR(DepthSigma(1), 1.4e-3, 1e-6);
  EXPECT_NEAR(DepthSigma(5), 0.035, 1e-6);
}

TEST(DepthSigma, GrowsWithTheSquareOfDepth) {
  EXPECT_NEAR(DepthSigma(4) / DepthSigma(2), 4, 1e-12);
}

TEST(DepthSigma, IsNeverUnderAMillimetre) {
  EXPECT_EQ(DepthSigma(0.3), 1e-3);
  EXPECT_EQ(DepthSigma(0), 1e-3);
}

TEST(DepthSigma, IsConstantInInverseDepth) {
  // d(1/z) = dz / z^2: why the estimators use inverse depth.
  EXPECT_NEAR(DepthSigma(1.5) / (1.5 * 1.5), DepthSigma(6) / (6 * 6), 1e-15);
}

}  // namespace
}  // namespace ofm
