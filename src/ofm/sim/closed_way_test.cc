#include "ofm/sim/closed_way.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ofm {
namespace {

using Eigen::Vector2d;

ClosedWay Square() { return ClosedWay({{0, 0}, {6, 0}, {6, 6}, {0, 6}}); }

TEST(ClosedWay, GoesStraightBetweenTheCorners) {
  const ClosedWay way = Square();
  EXPECT_NEAR(way.length_m(), 24, 1e-9);
  EXPECT_LT((way.At(3) - Vector2d(3, 0)).norm(), 1e-6);
  EXPECT_LT((way.At(9) - Vector2d(6, 3)).norm(), 1e-6);
  EXPECT_LT((way.At(21) - Vector2d(0, 3)).norm(), 1e-6);
}

TEST(ClosedWay, CutsCornersByLittle) {
  const double cut = (Square().At(6) - Vector2d(6, 0)).norm();
  EXPECT_GT(cut, 0.1);
  EXPECT_LT(cut, 0.4);
}

TEST(ClosedWay, GoesOnFromItsEndToItsStartInBothDirections) {
  const ClosedWay way = Square();
  EXPECT_LT((way.At(24.5) - way.At(0.5)).norm(), 1e-9);
  EXPECT_LT((way.At(-1) - way.At(23)).norm(), 1e-9);
}

TEST(ClosedWay, NeverJumpsAndNeverGoesFasterThanAsked) {
  const ClosedWay way = Square();
  for (double s = 0; s < 25; s += 0.03) EXPECT_LT((way.At(s + 0.03) - way.At(s)).norm(), 0.0301);
}

TEST(ClosedWay, NeedsTwoPlaces) {
  EXPECT_THROW(ClosedWay({{1, 1}}), std::logic_error);
  EXPECT_THROW(ClosedWay({{1, 1}, {1, 1}}), std::logic_error);
}

}  // namespace
}  // namespace ofm
