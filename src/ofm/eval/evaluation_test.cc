#include "ofm/eval/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::HasSubstr;
using testing::Not;

/// 50 poses of 0.1 s on a circle of which the estimate is 1 % too large.
Trajectory Circle(double radius_m, int count = 50) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.2 * i;
    trajectory.push_back(
        {i * 100'000'000LL,
         {ExpSo3({0, 0, angle}), {radius_m * std::cos(angle), radius_m * std::sin(angle), 0}}});
  }
  return trajectory;
}

TEST(CountInSpan, IncludesBothEnds) {
  const Trajectory groundtruth = Circle(1, 3);  // 0, 0.1 s, 0.2 s
  const std::vector<std::int64_t> stamps = {-1, 0, 50, 200'000'000, 200'000'001};
  EXPECT_EQ(CountInSpan(stamps, groundtruth), 3u);
  EXPECT_EQ(CountInSpan(stamps, {}), 0u);
}

TEST(EvaluateTrajectory, FillsEveryMeasure) {
  const TrajectoryEvaluation e = EvaluateTrajectory(Circle(1.01), Circle(1), {.frames = 100});
  EXPECT_EQ(e.ate.translation_m.count, 50u);
  EXPECT_NEAR(e.ate.translation_m.rmse, 0.01, 0.001);
  EXPECT_EQ(e.rpe_per_frame.translation_m.count, 48u);
  EXPECT_NEAR(e.rpe_per_frame.translation_m.mean, 0.01 * 2 * std::sin(0.1), 1e-9);
  EXPECT_EQ(e.rpe_1s.translation_m.count, 39u);
  EXPECT_NEAR(e.rpe_1s.translation_m.mean, 0.01 * 2 * std::sin(1), 1e-9);
  EXPECT_EQ(e.rpe_all_pairs.translation_m.count, 2500u);
  ASSERT_TRUE(e.coverage);
  EXPECT_EQ(e.coverage->poses, 50u);
  EXPECT_EQ(e.coverage->ratio(), 0.5);
}

TEST(EvaluateTrajectory, CoverageNeedsTheNumberOfFrames) {
  EXPECT_FALSE(EvaluateTrajectory(Circle(1), Circle(1)).coverage);
  EXPECT_THAT(ErrorOf([] { EvaluateTrajectory(Circle(1), Circle(1), {.frames = 49}); }),
              HasSubstr("50 estimated poses are more than the 49 frames"));
}

TEST(FormatEvaluation, ShowsEveryMeasureWithItsUnit) {
  const std::string table =
      FormatEvaluation(EvaluateTrajectory(Circle(1.01), Circle(1), {.frames = 64}));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 9);
  EXPECT_THAT(table, HasSubstr("pairs       rmse       mean     median        std"));
  EXPECT_THAT(table, HasSubstr("ATE            translation [m]          50   0.0"));
  EXPECT_THAT(table, HasSubstr("\nRPE per frame  translation [m]          48   0.001997"));
  EXPECT_THAT(table, HasSubstr("\n               rotation [deg]           48   0.000000"));
  EXPECT_THAT(table, HasSubstr("\nRPE over 1 s   translation [m]          39"));
  EXPECT_THAT(table, HasSubstr("\nRPE all pairs  translation [m]        2500"));
  EXPECT_THAT(table, HasSubstr("\ncoverage: 50 of 64 frames (78.1 %)\n"));
}

TEST(FormatEvaluation, AMeasureWithoutPairsIsADash) {
  const TrajectoryEvaluation e = EvaluateTrajectory(Circle(1, 5), Circle(1));
  EXPECT_THAT(FormatEvaluation(e),
              HasSubstr("RPE over 1 s   translation [m]           0          -          -"));
  EXPECT_THAT(FormatEvaluation(e), Not(HasSubstr("coverage")));
  EXPECT_TRUE(EvaluationToJson(e)["rpe_1s"].is_null());
  EXPECT_TRUE(EvaluationToJson(e)["coverage"].is_null());
}

TEST(EvaluationToJson, HoldsTheFigures) {
  const TrajectoryEvaluation e = EvaluateTrajectory(Circle(1.01), Circle(1), {.frames = 100});
  const nlohmann::ordered_json json = EvaluationToJson(e);
  EXPECT_EQ(json["ate"]["pairs"], 50);
  EXPECT_EQ(json["ate"]["translation_m"]["rmse"], e.ate.translation_m.rmse);
  EXPECT_EQ(json["ate"]["translation_m"]["max"], e.ate.translation_m.max);
  EXPECT_EQ(json["rpe_per_frame"]["translation_m"]["std"], e.rpe_per_frame.translation_m.std);
  EXPECT_EQ(json["rpe_1s"]["rotation_deg"]["median"], e.rpe_1s.rotation_deg.median);
  EXPECT_EQ(json["rpe_all_pairs"]["pairs"], 2500);
  EXPECT_EQ(json["coverage"]["ratio"], 0.5);
}

}  // namespace
}  // namespace ofm
