// The figures that the TUM RGB-D benchmark's own tools print for a published estimate.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>

#include "ofm/eval/ate.h"
#include "ofm/eval/rpe.h"
#include "ofm/io/table_file.h"
#include "ofm/io/trajectory_file.h"

namespace ofm {
namespace {

/// "name value unit" lines as name -> value.
std::map<std::string, std::string> ReadFigures(const std::filesystem::path& path) {
  const TableFile file(path);
  std::map<std::string, std::string> figures;
  for (const auto& row : file.rows()) {
    if (row.fields.size() == 3) figures[std::string(row.fields[0])] = row.fields[1];
  }
  return figures;
}

void AddFigures(const std::string& name, const ErrorStatistics& s,
                std::map<std::string, std::string>& figures) {
  figures["compared_pose_pairs"] = std::to_string(s.count);
  figures[name + ".rmse"] = fmt::format("{:.6f}", s.rmse);
  figures[name + ".mean"] = fmt::format("{:.6f}", s.mean);
  figures[name + ".median"] = fmt::format("{:.6f}", s.median);
  figures[name + ".std"] = fmt::format("{:.6f}", s.std);
  figures[name + ".min"] = fmt::format("{:.6f}", s.min);
  figures[name + ".max"] = fmt::format("{:.6f}", s.max);
}

class BenchmarkFigures : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(OFM_SHARED_DIR "/data/reference_trajectories") / GetParam();
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << "needs " << folder_;
    estimate_ = LoadTrajectory(folder_ / "estimate_dynaslam.txt");
    groundtruth_ = LoadTrajectory(folder_ / "groundtruth.txt");
  }

  std::filesystem::path folder_;
  Trajectory estimate_, groundtruth_;
};

TEST_P(BenchmarkFigures, AteEqualsTheToolsInEveryDigit) {
  const auto expected = ReadFigures(folder_ / "expected_ate.txt");
  std::map<std::string, std::string> figures;
  AddFigures("absolute_translational_error", ComputeAte(estimate_, groundtruth_).translation_m,
             figures);
  EXPECT_EQ(expected.size(), 7u);
  EXPECT_EQ(figures, expected);
}

TEST_P(BenchmarkFigures, RpeOverOneSecondEqualsTheToolsInEveryDigit) {
  const auto expected = ReadFigures(folder_ / "expected_rpe.txt");
  const RpeResult rpe = ComputeRpe(estimate_, groundtruth_);
  std::map<std::string, std::string> figures;
  AddFigures("translational_error", rpe.translation_m, figures);
  AddFigures("rotational_error", rpe.rotation_deg, figures);
  // The tool prints this one in radians.
  figures["rotational_error.median"] =
      fmt::format("{:.6f}", rpe.rotation_deg.median * std::numbers::pi / 180);
  EXPECT_EQ(expected.size(), 13u);
  EXPECT_EQ(figures, expected);
}

INSTANTIATE_TEST_SUITE_P(Fr3, BenchmarkFigures,
                         testing::Values("fr3_walking_xyz", "fr3_walking_halfsphere"),
                         [](const auto& sequence) { return std::string(sequence.param); });

}  // namespace
}  // namespace ofm
