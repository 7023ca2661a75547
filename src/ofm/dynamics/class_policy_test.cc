#include "ofm/dynamics/class_policy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"

namespace ofm {
namespace {

const std::vector<std::string> kNames = {"person", "cat", "tv"};

std::string ErrorOf(const DynamicsOptions& options) {
  try {
    ClassPolicies(options, kNames);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(ClassPolicies, EachClassHasThePolicyOfItsList) {
  DynamicsOptions options;
  options.always_dynamic = {"cat"};
  options.dynamic_classes = {"person"};
  options.never_dynamic = {"tv"};
  const ClassPolicies policies(options, kNames);
  EXPECT_EQ(policies.Of(ClassId(0)), ClassPolicy::kMayMove);
  EXPECT_EQ(policies.Of(ClassId(1)), ClassPolicy::kAlwaysDynamic);
  EXPECT_EQ(policies.Of(ClassId(2)), ClassPolicy::kNeverDynamic);
  EXPECT_TRUE(policies.MayMove(ClassId(0)));
  EXPECT_TRUE(policies.MayMove(ClassId(1)));
  EXPECT_FALSE(policies.MayMove(ClassId(2)));
}

TEST(ClassPolicies, UnlistedAndUnknownClassesAreJudgedByMotionAlone) {
  const ClassPolicies policies(DynamicsOptions{}, kNames);
  EXPECT_EQ(policies.Of(ClassId(1)), ClassPolicy::kUnknown);
  EXPECT_EQ(policies.Of(ClassId(77)), ClassPolicy::kUnknown);
  EXPECT_FALSE(policies.MayMove(ClassId(77)));
}

TEST(ClassPolicies, ASegmenterWithoutClassesNeedsNone) {
  const ClassPolicies policies(DynamicsOptions{}, {});
  EXPECT_EQ(policies.Of(ClassId(0)), ClassPolicy::kUnknown);
}

TEST(ClassPolicies, UnknownNamesAreErrorsThatNameTheOptionAndTheClasses) {
  DynamicsOptions options;
  options.never_dynamic = {"tvv"};
  EXPECT_THAT(ErrorOf(options), testing::HasSubstr("dynamics.never_dynamic"));
  EXPECT_THAT(ErrorOf(options), testing::HasSubstr("'tvv'; it has person, cat, tv"));
}

TEST(ClassPolicies, AClassInTwoListsIsAnError) {
  DynamicsOptions options;
  options.always_dynamic = {"person"};
  EXPECT_THAT(ErrorOf(options), testing::HasSubstr("'person' is named twice"));
}

}  // namespace
}  // namespace ofm
