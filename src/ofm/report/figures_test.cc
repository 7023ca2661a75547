#include "ofm/report/figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "ofm/dense/label_color.h"
#include "ofm/report/error_figures.h"
#include "ofm/report/hex_color.h"
#include "ofm/report/map_figure.h"
#include "ofm/report/map_image.h"
#include "ofm/report/report_page.h"
#include "ofm/report/scene_json.h"
#include "ofm/report/test_results.h"

namespace ofm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Two made runs, one five times as far off as the other.
class FiguresTest : public testing::Test {
 protected:
  FiguresTest() {
    test::WriteMadeResults(folder_.path() / "good", 0.01);
    test::WriteMadeResults(folder_.path() / "bad", 0.05);
  }

  ReportData Load() const {
    return LoadReportData({folder_.path() / "good", folder_.path() / "bad"},
                          test::WriteMadeTruth(folder_.path()));
  }
  ReportData LoadWithoutTruth() const { return LoadReportData({folder_.path() / "good"}, ""); }
  void Remove(const char* file) const { std::filesystem::remove(folder_.path() / "good" / file); }

  TestFolder folder_;
};

TEST_F(FiguresTest, EveryKindIsDrawnForBothRuns) {
  const ReportData data = Load();
  for (const std::string& name : FigureKindNames()) {
    const Figure figure = MakeFigure(ParseFigureKind(name).value(), data);
    EXPECT_FALSE(figure.empty()) << name;
    EXPECT_THAT(figure.missing, IsEmpty()) << name;
    const std::string svg = FigureToSvg(figure);
    EXPECT_GE(test::CountElements(svg, "polyline"), 2) << name;
    EXPECT_THAT(svg, HasSubstr("class=\"line run1\"")) << name;
  }
  EXPECT_FALSE(ParseFigureKind("pie"));
}

TEST_F(FiguresTest, ErrorsAreThoseOfTheRuns) {
  const Figure figure = MakeFigure(FigureKind::kAte, Load());
  ASSERT_THAT(figure.plots, SizeIs(1));
  const auto& series = figure.plots[0].series;
  ASSERT_THAT(series, SizeIs(2));
  const auto highest = [](const PlotSeries& s) {
    double most = 0;
    for (const Eigen::Vector2d& point : s.points) most = std::max(most, point.y());
    return most;
  };
  EXPECT_GT(highest(series[1]), 3 * highest(series[0]));
  EXPECT_LT(highest(series[1]), 7);  // centimetres
  EXPECT_THAT(figure.plots[0].description, HasSubstr("good: RMSE 0."));
}

TEST_F(FiguresTest, WithoutTruthErrorsAreMissingAndTheRestIsThere) {
  const ReportData data = LoadWithoutTruth();
  for (const FigureKind kind : {FigureKind::kAte, FigureKind::kRpe}) {
    const Figure figure = MakeFigure(kind, data);
    EXPECT_TRUE(figure.empty());
    EXPECT_THAT(figure.missing, ElementsAre(HasSubstr("--ground-truth")));
    EXPECT_THAT(ErrorOf([&] { FigureToSvg(figure); }), HasSubstr("--ground-truth"));
  }
  EXPECT_THAT(MakeFigure(FigureKind::kXyz, data).plots, SizeIs(3));
  EXPECT_THAT(MakeFigure(FigureKind::kPlan, data).plots, SizeIs(1));
}

TEST_F(FiguresTest, WhatARunLacksIsSaidWithItsName) {
  for (const char* file : {"frames.csv", "times.csv", "summary.json", "map.ply"}) Remove(file);
  const ReportData data = LoadWithoutTruth();
  EXPECT_THAT(MakeFigure(FigureKind::kCulled, data).missing, ElementsAre(HasSubstr("good: ")));
  EXPECT_THAT(MakeFigure(FigureKind::kTiming, data).missing,
              ElementsAre(HasSubstr("no summary.json")));
  EXPECT_THAT(MakeFigure(FigureKind::kMap, data).missing, ElementsAre(HasSubstr("no map.ply")));
}

TEST_F(FiguresTest, OfARunThatTrackedNothingSayIt) {
  folder_.Write("good/trajectory.txt", "# none\n");
  const ReportData data = LoadWithoutTruth();
  for (const FigureKind kind : {FigureKind::kPlan, FigureKind::kXyz}) {
    const Figure figure = MakeFigure(kind, data);
    EXPECT_TRUE(figure.empty());
    EXPECT_THAT(figure.missing, ElementsAre(HasSubstr("no frame was tracked")));
  }
}

TEST_F(FiguresTest, TheMapHasItsObjectsAndClasses) {
  const ReportData data = LoadWithoutTruth();
  const Figure figure = MakeFigure(FigureKind::kMap, data);
  ASSERT_THAT(figure.plots, SizeIs(1));
  EXPECT_THAT(figure.plots[0].outlines, SizeIs(3));
  EXPECT_EQ(figure.plots[0].labels[0].text, test::kNastyName);
  EXPECT_EQ(figure.plots[0].labels[1].text, "book");
  EXPECT_THAT(ClassesShown(data), ElementsAre(testing::Pair(1, test::kNastyName)));
}

TEST_F(FiguresTest, TheMapFromAboveHasTheColoursOfTheClasses) {
  ReportData data = LoadWithoutTruth();
  data.plan = MakePlanView({0, -1, 0});
  const auto image = DrawMapFromAbove(*data.runs[0].record.cloud, data.plan, data.runs[0]);
  ASSERT_TRUE(image);
  const cv::Mat picture = cv::imdecode(image->png, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(picture.type(), CV_8UC4);
  EXPECT_NEAR(image->x.length(), 2, 0.3);
  EXPECT_NEAR(1.0 * picture.cols / picture.rows, image->x.length() / image->y.length(), 0.05);
  const Rgb chair = LabelColor(1);
  int labelled = 0, drawn = 0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const auto pixel = picture.at<cv::Vec4b>(y, x);
      labelled += pixel == cv::Vec4b(chair.b, chair.g, chair.r, 255);
      drawn += pixel[3] == 255;
    }
  }
  EXPECT_NEAR(labelled, 0.17 * drawn, 0.04 * drawn);  // 14 x 19 of 40 x 40 points
}

TEST_F(FiguresTest, TheSceneHasItsPlacesWithinAMillimetre) {
  const ReportData data = LoadWithoutTruth();
  const nlohmann::ordered_json scene = SceneToJson(data);
  const auto& cloud = scene["runs"][0]["cloud"];
  EXPECT_EQ(cloud["count"], 1600);
  EXPECT_EQ(cloud["positions"].get<std::string>().size(), 1600U * 6 / 3 * 4);
  EXPECT_EQ(cloud["labels"].get<std::string>().size(), (1600U + 2) / 3 * 4);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(cloud["step"][axis].get<double>(), 1e-3);
  EXPECT_GT(scene["runs"][0]["voxels"]["count"], 100);
  EXPECT_TRUE(scene["truth"].is_null());
  EXPECT_EQ(scene["classes"][0]["color"], HexColor(LabelColor(1)));
}

TEST(BrokenAtGaps, BreaksALineWhereTimeIsMissing) {
  const auto points = BrokenAtGaps({{0, 1}, {0.1, 1}, {0.2, 1}, {2, 1}, {2.1, 1}});
  ASSERT_THAT(points, SizeIs(6));
  EXPECT_FALSE(points[3].allFinite());
  EXPECT_THAT(BrokenAtGaps({{0, 1}, {1, 1}, {2, 1}}), SizeIs(3));
  EXPECT_THAT(BrokenAtGaps({}), IsEmpty());
}

TEST(LabelColor, TellsClassesApart) {
  EXPECT_EQ(LabelColor(kNoLabel), kUnlabelledColor);
  for (std::uint8_t id = 0; id < 20; ++id) {
    const Rgb a = LabelColor(id), b = LabelColor(id + 1);
    EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 100) << int(id);
  }
  EXPECT_EQ(HexColor({1, 171, 255}), "#01abff");
}

}  // namespace
}  // namespace ofm
