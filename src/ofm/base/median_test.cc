#include "ofm/base/median.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ofm {
namespace {

TEST(UpperMedian, IsTheMiddleOneWhateverTheOrder) {
  EXPECT_EQ(UpperMedian<int>({5, 1, 9}), 5);
  EXPECT_EQ(UpperMedian<float>({2.5F}), 2.5F);
}

TEST(UpperMedian, OfAnEvenNumberIsTheLargerOfTwo) {
  EXPECT_EQ(UpperMedian<double>({4, 1, 3, 2}), 3);
  EXPECT_EQ(UpperMedian<double>({2, 1}), 2);
}

TEST(UpperMedian, OfNothingIsTheProgrammersFault) {
  EXPECT_THROW(UpperMedian<double>({}), std::logic_error);
}

}  // namespace
}  // namespace ofm
