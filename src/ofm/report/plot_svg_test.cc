#include "ofm/report/plot_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "ofm/report/svg.h"
#include "ofm/report/test_results.h"

namespace ofm {
namespace {

using test::CountElements;
using testing::HasSubstr;
using testing::Not;

Plot SomePlot() {
  Plot plot;
  plot.title = "Errors of <a> & \"b\"";
  plot.description = "a: 1 cm";
  plot.x_label = "time [s]", plot.y_label = "error [cm]";
  plot.series = {{"a", "run0", SeriesStyle::kLine, {{0, 1}, {1, 3}, {2, 2}}},
                 {"truth", "truth", SeriesStyle::kDashed, {{0, 0}, {2, 0}}}};
  return plot;
}

pugi::xml_document Parse(const std::string& svg) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str())) << svg.substr(0, 200);
  return document;
}

TEST(SvgNumber, HasOneDecimalAtMost) {
  EXPECT_EQ(SvgNumber(1.26), "1.3");
  EXPECT_EQ(SvgNumber(7), "7");
  EXPECT_EQ(SvgNumber(-0.01), "0");
}

TEST(AddSvgPath, IsBrokenWhereAPointIsNotFinite) {
  pugi::xml_document document;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Eigen::Vector2d> points = {{0, 0}, {1, 1}, {nan, 2}, {3, 3}, {4, nan}};
  AddSvgPath(document.append_child("svg"), "line", points);
  EXPECT_EQ(CountElements(SvgText(document), "polyline"), 2);
  EXPECT_STREQ(document.first_child().first_child().attribute("points").value(), "0,0 1,1");
}

TEST(AddSvgPath, ThinsLongLinesOutAndKeepsTheirPeaks) {
  pugi::xml_document document;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 100000; ++i) points.emplace_back(0.004 * i, i == 54321 ? 99.5 : i % 7);
  AddSvgPath(document.append_child("svg"), "line", points);
  const std::string text = SvgText(document);
  EXPECT_LT(text.size(), 40000U);
  EXPECT_THAT(text, HasSubstr(",99.5 "));
}

TEST(PlotToSvg, IsXmlWithTitleAxesAndLegend) {
  const std::string svg = PlotToSvg(SomePlot(), SvgUse::kStandalone);
  const pugi::xml_document document = Parse(svg);
  const pugi::xml_node root = document.document_element();
  EXPECT_STREQ(root.attribute("role").value(), "img");
  EXPECT_STREQ(root.attribute("aria-label").value(), "Errors of <a> & \"b\". a: 1 cm");
  EXPECT_EQ(CountElements(svg, "polyline"), 2);
  EXPECT_EQ(CountElements(svg, "text[@class='legend']"), 2);
  EXPECT_EQ(CountElements(svg, "text[@class='label']"), 2);
  EXPECT_GE(CountElements(svg, "text[@class='tick']"), 6);
  EXPECT_EQ(CountElements(svg, "style"), 1);
  EXPECT_EQ(CountElements(svg, "text[@class='title']"), 1);
}

TEST(PlotToSvg, LeavesStyleAndTitleToThePage) {
  const std::string svg = PlotToSvg(SomePlot(), SvgUse::kInPage);
  EXPECT_EQ(CountElements(svg, "style"), 0);
  EXPECT_EQ(CountElements(svg, "text[@class='title']"), 0);
  EXPECT_THAT(svg, Not(HasSubstr("<?xml")));
}

TEST(PlotToSvg, StaysWithinItsFrame) {
  for (const PlotShape shape : {PlotShape::kFree, PlotShape::kEqualScales}) {
    Plot plot = SomePlot();
    plot.shape = shape;
    plot.series[0].points = {{-1e6, 5}, {2e6, 5.001}};
    const pugi::xml_document document = Parse(PlotToSvg(plot, SvgUse::kInPage));
    for (const auto& node : document.select_nodes("//line")) {
      for (const char* name : {"x1", "x2"}) {
        EXPECT_GE(node.node().attribute(name).as_double(), 0);
        EXPECT_LE(node.node().attribute(name).as_double(), 480);
      }
    }
  }
}

TEST(PlotToSvg, EqualScalesDrawACircleRound) {
  Plot plot;
  plot.shape = PlotShape::kEqualScales;
  PlotSeries circle{"", "run0", SeriesStyle::kDots, {}};
  for (int i = 0; i < 4; ++i) {
    const double angle = i * std::numbers::pi / 2;
    circle.points.emplace_back(5 + 3 * std::cos(angle), 3 * std::sin(angle));
  }
  plot.series.push_back(circle);
  const pugi::xml_document document = Parse(PlotToSvg(plot, SvgUse::kInPage));
  Interval x = EmptyInterval(), y = EmptyInterval();
  for (const auto& dot : document.select_nodes("//circle")) {
    Include(x, dot.node().attribute("cx").as_double());
    Include(y, dot.node().attribute("cy").as_double());
  }
  EXPECT_GT(x.length(), 100);
  EXPECT_NEAR(x.length(), y.length(), 0.3);
}

TEST(PlotToSvg, OfNothingIsAnEmptyFrame) {
  const std::string svg = PlotToSvg(Plot{}, SvgUse::kInPage);
  EXPECT_EQ(CountElements(svg, "polyline"), 0);
  EXPECT_EQ(CountElements(svg, "line[@class='axis']"), 2);
}

TEST(PlotToSvg, AnErrorsAxisBeginsAtZero) {
  Plot plot = SomePlot();
  plot.baseline = PlotBaseline::kZero;
  plot.series = {{"a", "run0", SeriesStyle::kLine, {{0, 100}, {1, 101}}}};
  EXPECT_GE(CountElements(PlotToSvg(plot, SvgUse::kInPage), "text[@class='tick' and .='0']"), 2);
}

TEST(PlotToSvg, DrawsImageOutlinesAndLabelsEscaped) {
  Plot plot = SomePlot();
  plot.image = PlotImage{{1, 2, 3}, {0, 2}, {0, 3}};
  plot.outlines = {{{{0, 0}, {1, 0}, {1, 1}}}};
  plot.labels = {{{1, 1}, test::kNastyName}};
  const std::string svg = PlotToSvg(plot, SvgUse::kInPage);
  EXPECT_EQ(CountElements(svg, "image"), 1);
  EXPECT_EQ(CountElements(svg, "polygon"), 1);
  EXPECT_EQ(CountElements(svg, "script"), 0);
  EXPECT_STREQ(Parse(svg).select_node("//text[@class='place']").node().text().get(),
               test::kNastyName);
}

TEST(BarChart, HasABarAndAWhiskerForEachRun) {
  BarChart chart;
  chart.runs = {"a", "b"};
  chart.groups = {{"tracking", {{0, 2, 5}, {1, 3, 9}}}, {"<dense>", {{1, 1, 1}}}};
  const std::string svg = PlotToSvg(chart, SvgUse::kStandalone);
  EXPECT_EQ(CountElements(svg, "rect[contains(@class, 'bar')]"), 3);
  EXPECT_EQ(CountElements(svg, "line[contains(@class, 'whisker')]"), 3);
  const auto width = [&](const char* place) {
    return Parse(svg).select_node(place).node().attribute("width").as_double();
  };
  EXPECT_NEAR(width("//rect[@class='bar run1'][1]"), 1.5 * width("//rect[@class='bar run0']"), 0.3);
}

TEST(StackSvg, IsAsHighAsItsParts) {
  const std::string one = PlotToSvg(SomePlot(), SvgUse::kStandalone);
  const std::string two = StackSvg(std::vector{one, one});
  const double height = Parse(one).document_element().attribute("height").as_double();
  EXPECT_NEAR(Parse(two).document_element().attribute("height").as_double(), 2 * height, 0.2);
  EXPECT_EQ(CountElements(two, "polyline"), 4);
}

}  // namespace
}  // namespace ofm
