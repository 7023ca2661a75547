#include "ofm/base/check.h"

#include <gmock/gmock.h>

namespace ofm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Check, NamesTheConditionAndThePlace) {
  const int answer = 41;
  EXPECT_THAT([&] { OFM_CHECK(answer == 42); },
              ThrowsMessage<std::logic_error>(
                  AllOf(HasSubstr("answer == 42"), HasSubstr("check_test.cc:"))));
}

TEST(Check, EvaluatesItsConditionOnce) {
  int evaluated = 0;
  OFM_CHECK(++evaluated > 0);
  EXPECT_EQ(evaluated, 1);
}

TEST(Check, IsOneStatement) {
  bool other_branch = false;
  if (other_branch)
    OFM_CHECK(false);
  else
    other_branch = true;
  EXPECT_TRUE(other_branch);
}

}  // namespace
}  // namespace ofm
