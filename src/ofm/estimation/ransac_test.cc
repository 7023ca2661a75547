#include "ofm/estimation/ransac.h"

#include <gtest/gtest.h>

namespace ofm {
namespace {

TEST(RansacIterations, AreThoseOfTheTextbook) {
  // Fischler and Bolles: log(1 - 0.99) / log(1 - 0.5^3) = 34.5.
  EXPECT_EQ(RansacIterations(0.5, {300, 0.99}), 35);
}

TEST(RansacIterations, EndAtTheLimitAndAtOnceWhereAllIsRight) {
  EXPECT_EQ(RansacIterations(0.01, {300, 0.99}), 300);
  EXPECT_EQ(RansacIterations(0, {300, 0.99}), 300);
  EXPECT_EQ(RansacIterations(1, {300, 0.99}), 1);
}

}  // namespace
}  // namespace ofm
