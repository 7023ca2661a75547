#include "ofm/pipeline/frame_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kHeader =
    "stamp,status,keyframe,masked_share,instances,features,inliers\n";

std::vector<FrameRecord> SomeFrames() {
  return {{1'500'000'000, TrackingStatus::kInitialized, true, 0.25, 2, 800, 0},
          {1'533'000'000, TrackingStatus::kTracked, false, 0, 0, 900, 120},
          {1'566'000'000, TrackingStatus::kLost, false, 1, 1, 0, 0}};
}

TEST(FrameTable, IsReadBackAsItWasWritten) {
  const TestFolder folder;
  const auto file = folder.Write("frames.csv", FormatFrames(SomeFrames()));
  EXPECT_EQ(LoadFrames(file), SomeFrames());
}

TEST(FrameTable, OfNoFrameHasAHeaderOnly) {
  const TestFolder folder;
  EXPECT_EQ(FormatFrames({}), kHeader);
  EXPECT_THAT(LoadFrames(folder.Write("frames.csv", kHeader)), IsEmpty());
}

TEST(FrameTable, BadLinesAreNamed) {
  const TestFolder folder;
  const auto error = [&](const std::string& line) {
    const auto file = folder.Write("frames.csv", std::string(kHeader) + line);
    return ErrorOf([&] { LoadFrames(file); });
  };
  EXPECT_THAT(error("1,tracked,0,0,0,5"), AllOf(HasSubstr("frames.csv:2: "), HasSubstr("7")));
  EXPECT_THAT(error("1,running,0,0,0,5,5"), HasSubstr("no state of tracking"));
  EXPECT_THAT(error("1,tracked,0,1.5,0,5,5"), HasSubstr("0 to 1"));
  EXPECT_THAT(error("1,tracked,0,0,-1,5,5"), HasSubstr("no count"));
  EXPECT_THAT(error("1,lost,0,0,0,5,5\n1,lost,0,0,0,5,5"), HasSubstr("frames.csv:3: time"));
  EXPECT_THAT(ErrorOf([&] { LoadFrames(folder.Write("empty.csv", "")); }),
              HasSubstr("names the columns"));
  EXPECT_THAT(ErrorOf([&] { LoadFrames(folder.Write("other.csv", "x,y\n")); }),
              HasSubstr("other.csv:1: "));
}

TEST(FrameTimes, AreOfTheStagesThatRanOnceAFrame) {
  StageTimes times;
  for (const double cpu_ms : {1.5, 2.5, 3.25}) times.Add("tracking", 99, cpu_ms);
  times.Add("mapping", 99, 50);
  const FrameTimes frames = TimesOfFrames(SomeFrames(), times);
  EXPECT_THAT(frames.stages, ElementsAre("tracking"));
  const TestFolder folder;
  const FrameTimes loaded = LoadFrameTimes(folder.Write("times.csv", FormatFrameTimes(frames)));
  EXPECT_EQ(loaded.stamps_ns, frames.stamps_ns);
  EXPECT_THAT(loaded.stages, ElementsAre("tracking"));
  EXPECT_THAT(loaded.cpu_ms, ElementsAre(ElementsAre(1.5, 2.5, 3.25)));
}

TEST(FrameTimes, OfNoStageAreStampsAlone) {
  const TestFolder folder;
  const FrameTimes loaded =
      LoadFrameTimes(folder.Write("times.csv", FormatFrameTimes(TimesOfFrames(SomeFrames(), {}))));
  EXPECT_EQ(loaded.stamps_ns.size(), 3U);
  EXPECT_THAT(loaded.stages, IsEmpty());
}

TEST(FrameTimes, BadLinesAreNamed) {
  const TestFolder folder;
  const auto error = [&](const char* text) {
    return ErrorOf([&] { LoadFrameTimes(folder.Write("times.csv", text)); });
  };
  EXPECT_THAT(error("stamp,a\n1,2,3\n"), HasSubstr("times.csv:2: has 3 fields"));
  EXPECT_THAT(error("stamp,a\n1,x\n"), HasSubstr("times.csv:2: 'x' is not a finite number"));
}

}  // namespace
}  // namespace ofm
