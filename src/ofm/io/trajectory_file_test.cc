#include "ofm/io/trajectory_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::EndsWith;
using testing::IsEmpty;
using testing::StartsWith;

/// The message for a trajectory whose third line is `line`, without the folder.
std::string ErrorOfLine(const std::string& line) {
  const TestFolder folder;
  const auto path = folder.Write("t.txt", "# comment\n1 0 0 0 0 0 0 1\n" + line + "\n");
  const std::string message = ErrorOf([&] { LoadTrajectory(path); });
  EXPECT_THAT(message, StartsWith(path.string() + ":3: "));
  return message.substr(std::min(message.size(), folder.path().string().size() + 1));
}

TEST(TrajectoryFile, ReadsTheTumFormat) {
  const TestFolder folder;
  const Trajectory trajectory =
      LoadTrajectory(folder.Write("t.txt",
                                  "# ground truth trajectory\n"
                                  "1305031452.3696 1.25 -0.5 1.5417 0 0 0 2\n"
                                  "1305031452.3795 1 2 3 0.70710678 0 0 0.70710678\n"));
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp_ns, 1305031452369600000);
  EXPECT_EQ(trajectory[0].world_from_camera.translation(), Eigen::Vector3d(1.25, -0.5, 1.5417));
  EXPECT_EQ(trajectory[0].world_from_camera.rotation().w(), 1);  // normalised
  EXPECT_NEAR(trajectory[1].world_from_camera.RotationAngle(), std::acos(0.0), 1e-7);
  EXPECT_NEAR(trajectory[1].world_from_camera.rotation().x(), std::sqrt(0.5), 1e-8);
}

TEST(TrajectoryFile, RoundTripKeepsEveryDigitWritten) {
  const TestFolder folder;
  Trajectory trajectory;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d axis_angle(0.1 * i, -0.03 * i, std::sin(i));
    trajectory.push_back({1305031453359684000 + i * 33'333'000,
                          {ExpSo3(axis_angle), {std::cos(i), 1e-9 * i, -123.456789012 * i}}});
  }
  SaveTrajectory(folder.path() / "a.txt", trajectory);
  const Trajectory back = LoadTrajectory(folder.path() / "a.txt");
  ASSERT_EQ(back.size(), trajectory.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].stamp_ns, trajectory[i].stamp_ns);
    const RigidTransform &a = back[i].world_from_camera, &b = trajectory[i].world_from_camera;
    EXPECT_LT((a.translation() - b.translation()).cwiseAbs().maxCoeff(), 0.51e-9);
    EXPECT_LT((a.rotation().coeffs() - b.rotation().coeffs()).cwiseAbs().maxCoeff(), 2e-9);
  }
  EXPECT_EQ(FormatTrajectory(back).size(), ReadFile(folder.path() / "a.txt").size());
}

TEST(TrajectoryFile, SaysItsConventionAndWritesFixedDecimals) {
  const Trajectory trajectory = {{1'500'000'400, {Eigen::Quaterniond::Identity(), {1, -2, 0.5}}}};
  EXPECT_EQ(FormatTrajectory(trajectory),
            "# timestamp tx ty tz qx qy qz qw of world_from_camera [s, m, unit quaternion]\n"
            "1.500000 1.000000000 -2.000000000 0.500000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000\n");
}

TEST(TrajectoryFile, EmptyIsValid) {
  const TestFolder folder;
  SaveTrajectory(folder.path() / "a.txt", {});
  EXPECT_THAT(LoadTrajectory(folder.path() / "a.txt"), IsEmpty());
}

TEST(TrajectoryFile, NamesTheLineOfBadValues) {
  EXPECT_EQ(ErrorOfLine("2 0 0 nan 0 0 0 1"), "t.txt:3: 'nan' is not a finite number");
  EXPECT_EQ(ErrorOfLine("2 0 -inf 0 0 0 0 1"), "t.txt:3: '-inf' is not a finite number");
  EXPECT_EQ(ErrorOfLine("nan 0 0 0 0 0 0 1"), "t.txt:3: 'nan' is not a time in seconds");
  EXPECT_EQ(ErrorOfLine("2 0 0 0 0 0 0 one"), "t.txt:3: 'one' is not a finite number");
}

TEST(TrajectoryFile, NamesTheLineOfWrongCounts) {
  EXPECT_EQ(ErrorOfLine("2 0 0 0 0 0 0"),
            "t.txt:3: has 7 fields where 8 are needed: timestamp tx ty tz qx qy qz qw");
  EXPECT_THAT(ErrorOfLine("2 0 0 0 0 0 0 1 9"), StartsWith("t.txt:3: has 9 fields"));
}

TEST(TrajectoryFile, NamesTheLineOfAZeroQuaternion) {
  EXPECT_EQ(ErrorOfLine("2 1 2 3 0 0 0 0"),
            "t.txt:3: the quaternion qx qy qz qw is zero: no rotation");
}

TEST(TrajectoryFile, NamesTheLineWhereTimeGoesBack) {
  EXPECT_THAT(ErrorOfLine("0.5 0 0 0 0 0 0 1"),
              StartsWith("t.txt:3: time 0.500000 does not come after 1.000000 of line 2"));
  EXPECT_THAT(ErrorOfLine("1 0 0 0 0 0 0 1"), EndsWith("remove duplicates"));
}

TEST(TrajectoryFile, NamesAMissingFile) {
  EXPECT_EQ(ErrorOf([] { LoadTrajectory("/no/such.txt"); }),
            "/no/such.txt: does not exist; check the path");
}

TEST(TrajectoryFile, FailedSaveLeavesTheOldFile) {
  const TestFolder folder;
  const auto path = folder.Write("sub/a.txt", "old");
  EXPECT_NE(ErrorOf([&] { SaveTrajectory(folder.path() / "none/a.txt", {}); }), "");
  EXPECT_EQ(ReadFile(path), "old");
}

TEST(TrajectoryFile, ReadsTheBenchmarksFiles) {
  const std::filesystem::path path = OFM_SHARED_DIR "/data/tum_fr1_desk/groundtruth.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  EXPECT_EQ(LoadTrajectory(path).size(), 2078u);
}

}  // namespace
}  // namespace ofm
