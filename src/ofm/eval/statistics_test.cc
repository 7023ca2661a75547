#include "ofm/eval/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace ofm {
namespace {

TEST(ErrorStatistics, AreThoseOfTheTextbook) {
  const std::vector<double> errors = {4, 1, 3, 2, 10};
  const ErrorStatistics s = ComputeStatistics(errors);
  EXPECT_EQ(s.count, 5u);
  EXPECT_DOUBLE_EQ(s.mean, 4);
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(26));
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(10));  // of the population: divided by 5, not by 4
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.max, 10);
}

TEST(ErrorStatistics, MedianOfAnEvenNumberIsTheMeanOfTheMiddleTwo) {
  EXPECT_DOUBLE_EQ(ComputeStatistics(std::vector<double>{9, 1, 2, 4}).median, 3);
  EXPECT_DOUBLE_EQ(ComputeStatistics(std::vector<double>{2, 1}).median, 1.5);
}

TEST(ErrorStatistics, OfOneErrorAreThatError) {
  const ErrorStatistics s = ComputeStatistics(std::vector<double>{0.25});
  EXPECT_EQ(s.count, 1u);
  EXPECT_EQ(s.rmse, 0.25);
  EXPECT_EQ(s.median, 0.25);
  EXPECT_EQ(s.std, 0);
  EXPECT_EQ(s.min, 0.25);
  EXPECT_EQ(s.max, 0.25);
}

TEST(ErrorStatistics, OfNothingAreZero) {
  const ErrorStatistics s = ComputeStatistics({});
  EXPECT_EQ(s.count, 0u);
  EXPECT_EQ(s.rmse, 0);
}

}  // namespace
}  // namespace ofm
