#include "ofm/report/run_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/report/test_results.h"

namespace ofm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr RecordLimits kAll = {100000, 100000};

class RunRecordTest : public testing::Test {
 protected:
  RunRecordTest() { test::WriteMadeResults(folder_.path()); }

  std::string LoadError() const {
    return ErrorOf([&] { LoadRunRecord(folder_.path(), kAll); });
  }

  TestFolder folder_;
};

TEST_F(RunRecordTest, HasEveryPieceOfAFolder) {
  const RunRecord record = LoadRunRecord(folder_.path(), kAll);
  EXPECT_EQ(record.name, folder_.path().filename());
  EXPECT_EQ(record.trajectory.size(), 60U);
  EXPECT_EQ(record.live.value().size(), 60U);
  EXPECT_EQ(record.keyframes.value().size(), 6U);
  EXPECT_EQ(record.frames.value().size(), 60U);
  EXPECT_EQ(record.times.value().stages.size(), 1U);
  EXPECT_EQ(record.cloud.value().points.size(), 1600U);
  EXPECT_GT(record.voxels.value().voxels.size(), 100U);
  EXPECT_EQ(record.objects.value().objects.size(), 3U);
  ASSERT_EQ(record.pictures.size(), 1U);
  EXPECT_EQ(record.pictures[0].stamp_ns, 1000'500'000'000);
  const RunSummary& summary = record.summary.value();
  EXPECT_EQ(summary.input, "/nowhere/<desk>");
  EXPECT_EQ(summary.error, "");
  EXPECT_EQ(summary.seed, 3U);
  EXPECT_EQ(summary.landmarks, 1234U);
  EXPECT_EQ(summary.loops_closed, 1U);
  EXPECT_EQ(summary.mean_masked_share, 0.25);
  EXPECT_FALSE(summary.ate_rmse_m);
  ASSERT_EQ(summary.stages.size(), 2U);
  EXPECT_EQ(summary.stages[0].name, "tracking");
  EXPECT_EQ(summary.stages[0].p99_ms, 6.0);
}

TEST_F(RunRecordTest, NeedsNothingButTheTrajectory) {
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    if (entry.path().filename() != "trajectory.txt") std::filesystem::remove_all(entry.path());
  }
  const RunRecord record = LoadRunRecord(folder_.path(), kAll);
  EXPECT_EQ(record.trajectory.size(), 60U);
  EXPECT_FALSE(record.summary || record.frames || record.cloud || record.objects);
  EXPECT_TRUE(record.pictures.empty());
}

TEST_F(RunRecordTest, LeavesMapsAsideWhereNoneIsWanted) {
  folder_.Write("map.ply", "damaged");
  const RunRecord record = LoadRunRecord(folder_.path(), {});
  EXPECT_FALSE(record.cloud || record.voxels);
}

TEST_F(RunRecordTest, DamagedFilesAreNamedWithTheirLine) {
  folder_.Write("summary.json", "{\n\"a\": 1,\n!");
  EXPECT_THAT(LoadError(), HasSubstr("summary.json:3: is no JSON"));
  folder_.Write("summary.json", "[]");
  EXPECT_THAT(LoadError(), HasSubstr("summary.json:1: "));
  folder_.Write("summary.json", R"({"counts": {"frames": "many"}})");
  EXPECT_THAT(LoadError(), HasSubstr("summary.json: has no fitting value for 'counts/frames'"));
  folder_.Write("summary.json", R"({"stages": 5})");
  EXPECT_THAT(LoadError(), HasSubstr("'stages'"));
  folder_.Write("summary.json", "{}");
  folder_.Write("frames.csv", "stamp\n1\n");
  EXPECT_THAT(LoadError(), HasSubstr("frames.csv:2: "));
  folder_.Write("trajectory.txt", "1 2 3\n");
  EXPECT_THAT(LoadError(), HasSubstr("trajectory.txt:1: "));
}

TEST_F(RunRecordTest, SaysWhatToNameWhereAFolderIsNone) {
  EXPECT_THAT(ErrorOf([] { LoadRunRecord("/nowhere", kAll); }),
              HasSubstr("/nowhere: is no folder; name one that ofm-slam run has written"));
  std::filesystem::remove(folder_.path() / "trajectory.txt");
  EXPECT_THAT(LoadError(), HasSubstr("has no trajectory.txt"));
}

TEST(NamesOf, AreShortAndDifferent) {
  EXPECT_THAT(NamesOf({"/a/b/out"}), ElementsAre("out"));
  EXPECT_THAT(NamesOf({"/a/b/out/"}), ElementsAre("out"));
  EXPECT_THAT(NamesOf({"/x/one", "/x/two"}), ElementsAre("one", "two"));
  EXPECT_THAT(NamesOf({"/x/1/out", "/x/2/out"}), ElementsAre("1/out", "2/out"));
  EXPECT_EQ(NamesOf({"/x/out", "/x/out"}).size(), 2U);
}

}  // namespace
}  // namespace ofm
