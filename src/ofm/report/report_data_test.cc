#include "ofm/report/report_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/report/test_results.h"

namespace ofm {
namespace {

using testing::HasSubstr;

/// A run whose world is another one than the truth's.
RunRecord MovedRun(const RigidTransform& run_from_truth) {
  RunRecord record;
  record.name = "moved";
  for (const auto& [stamp_ns, pose] : test::MadeTrajectory(60, 0)) {
    record.trajectory.push_back({stamp_ns, run_from_truth * pose});
  }
  return record;
}

TEST(PlanView, LooksDownTheAxisThatIsUp) {
  const PlanView up_z = MakePlanView({0, 0, 1});
  EXPECT_EQ(up_z({1, 2, 3}), Eigen::Vector2d(1, 2));
  EXPECT_EQ(up_z.x_label, "x [m]");
  EXPECT_EQ(up_z.y_label, "y [m]");
  const PlanView camera = MakePlanView({0, -1, 0});
  EXPECT_EQ(camera({1, 2, 3}), Eigen::Vector2d(1, 3));
  EXPECT_EQ(camera.y_label, "z [m]");
  const PlanView up_x = MakePlanView({1, 0, 0});
  EXPECT_EQ(up_x({1, 2, 3}), Eigen::Vector2d(2, 3));
}

TEST(PlanView, IsLevelWhereUpIsNoAxis) {
  const PlanView view = MakePlanView(Eigen::Vector3d(0, -.8, -.6));
  EXPECT_LT(view({0, -.8, -.6}).norm(), 1e-12);
  EXPECT_NEAR(view({0, .6, -.8}).norm(), 1, 1e-12);
  EXPECT_EQ(view.x_label, "right [m]");
}

TEST(ReportData, BringsRunsIntoTheWorldOfTheTruth) {
  const TestFolder folder;
  const RigidTransform run_from_truth(ExpSo3({1, -0.5, 2}), {4, 5, 6});
  const ReportData data =
      MakeReportData({MovedRun(run_from_truth)}, test::WriteMadeTruth(folder.path()));
  ASSERT_TRUE(data.runs[0].errors);
  EXPECT_LT(data.runs[0].errors->ate.translation_m.max, 1e-6);
  EXPECT_LT(data.runs[0].errors->rpe_1s.translation_m.max, 1e-6);
  EXPECT_EQ(data.runs[0].errors->ate.errors.size(), 60U);
  EXPECT_EQ(data.truth.size(), 60U);
  EXPECT_EQ(data.Seconds(1000'500'000'000), 0.5);
  const Eigen::Vector3d place = run_from_truth * Eigen::Vector3d(1, 2, 3);
  EXPECT_LT((data.runs[0].report_from_run * place - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
}

TEST(ReportData, WithoutTruthStaysInTheRunsWorldAndSaysHowToGetErrors) {
  const ReportData data = MakeReportData({MovedRun({})}, "");
  EXPECT_FALSE(data.runs[0].errors);
  EXPECT_THAT(data.runs[0].why_no_errors, HasSubstr("--ground-truth"));
  EXPECT_EQ(data.runs[0].trajectory.size(), 60U);
  EXPECT_TRUE(data.truth.empty());
}

TEST(ReportData, FindsTheTruthBesideTheInput) {
  const TestFolder folder;
  std::filesystem::rename(test::WriteMadeTruth(folder.path()), folder.path() / "groundtruth.txt");
  RunRecord record = MovedRun({});
  record.summary.emplace().input = folder.path();
  const ReportData data = MakeReportData({record}, "");
  EXPECT_EQ(data.truth_file, folder.path() / "groundtruth.txt");
  EXPECT_TRUE(data.runs[0].errors);
}

TEST(ReportData, OfAnotherTimeHasNoErrorsAndSaysWhy) {
  const TestFolder folder;
  RunRecord late = MovedRun({});
  for (StampedPose& pose : late.trajectory) pose.stamp_ns += 3'600'000'000'000;
  const ReportData data = MakeReportData({MovedRun({}), late}, test::WriteMadeTruth(folder.path()));
  EXPECT_TRUE(data.runs[0].errors);
  EXPECT_FALSE(data.runs[1].errors);
  EXPECT_THAT(data.runs[1].why_no_errors, HasSubstr("No errors against the ground truth"));
}

TEST(ReportData, WantsATruthOfTwoPoses) {
  const TestFolder folder;
  const auto file = folder.Write("truth.txt", "1 0 0 0 0 0 0 1\n");
  EXPECT_THAT(ErrorOf([&] { MakeReportData({MovedRun({})}, file); }),
              HasSubstr("truth.txt: holds fewer than 2 poses"));
  EXPECT_THAT(ErrorOf([&] { MakeReportData({MovedRun({})}, "/nowhere.txt"); }),
              HasSubstr("/nowhere.txt: does not exist"));
}

}  // namespace
}  // namespace ofm
