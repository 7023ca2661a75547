#include "ofm/report/report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "ofm/report/assets.h"
#include "ofm/report/test_results.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ReportPageTest : public testing::Test {
 protected:
  ReportPageTest() { test::WriteMadeResults(folder()); }

  std::filesystem::path folder() const { return root_.path() / "out"; }
  /// The page up to the viewer's script, which is no text of ours.
  std::string Page(const std::filesystem::path& truth = {}) const {
    const std::string page = ReportPage(LoadReportData({folder()}, truth), "9.9");
    return page.substr(0, page.find("The 3-D view of ofm-slam"));
  }

  TestFolder root_;
};

TEST_F(ReportPageTest, HasEverySectionOfAWholeRun) {
  const std::string page = Page(test::WriteMadeTruth(root_.path()));
  for (const char* anchor :
       {"summary", "trajectory", "errors", "culling", "map", "objects", "timing"}) {
    EXPECT_THAT(page, HasSubstr("<h2 id=\"" + std::string(anchor) + "\">"));
  }
  EXPECT_THAT(page,
              AllOf(HasSubstr("ATE, RMSE"), HasSubstr("from above"), HasSubstr("RPE over 1 s"),
                    HasSubstr("data:image/jpeg;base64,"), HasSubstr("25.0 % masked"),
                    HasSubstr("id=\"viewer\""), HasSubstr("book"), HasSubstr("tracks of"),
                    HasSubstr("CPU time by stage"), HasSubstr("ofm-slam 9.9")));
  EXPECT_THAT(page, Not(HasSubstr("class=\"missing")));
}

TEST_F(ReportPageTest, RefersToNothingOutside) {
  const std::string page = Page();
  std::string addresses;
  const std::regex reference("(src|href)=\"([^\"#][^\"]{0,30})");
  for (std::sregex_iterator i(page.begin(), page.end(), reference), end; i != end; ++i) {
    if (!(*i)[2].str().starts_with("data:")) addresses += (*i)[2].str() + " ";
  }
  EXPECT_EQ(addresses, "");
  EXPECT_THAT(page, Not(HasSubstr("@import")));
}

TEST_F(ReportPageTest, EscapesWhatFilesSay) {
  const std::string page = Page();
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, AllOf(HasSubstr("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&amp;&quot;"),
                          HasSubstr("/nowhere/&lt;desk&gt;")));
}

TEST_F(ReportPageTest, ItsPlotsAreXmlWithTextAlternatives) {
  const std::string page = Page(test::WriteMadeTruth(root_.path()));
  int plots = 0;
  for (std::size_t begin = page.find("<svg"); begin != std::string::npos;
       begin = page.find("<svg", begin + 1)) {
    const std::string svg = page.substr(begin, page.find("</svg>", begin) + 6 - begin);
    EXPECT_EQ(test::CountElements(svg, "svg[@role='img' and string-length(@aria-label) > 8]"), 1);
    ++plots;
  }
  EXPECT_EQ(plots, 12);  // plan, x, y, z, ate, 3 rpe, culled, map, bars and frames' times
}

TEST_F(ReportPageTest, ItsSceneIsJson) {
  const std::string page = Page();
  const std::string open = "id=\"scene-data\">";
  const std::size_t begin = page.find(open) + open.size();
  const auto scene =
      nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(scene["runs"][0]["name"], "out");
  EXPECT_EQ(scene["classes"][0]["name"], test::kNastyName);
}

TEST_F(ReportPageTest, IsTheSameTwice) { EXPECT_EQ(Page(), Page()); }

/// What is said where a file is not there.
struct MissingCase {
  const char* file;
  const char* said;
};

class MissingPiece : public ReportPageTest, public testing::WithParamInterface<MissingCase> {};

TEST_P(MissingPiece, IsSaidWithHowToGetIt) {
  std::filesystem::remove_all(folder() / GetParam().file);
  const std::string page = Page(test::WriteMadeTruth(root_.path()));
  EXPECT_THAT(page, HasSubstr("<p class=\"missing\">out: "));
  EXPECT_THAT(page, HasSubstr(GetParam().said));
}

INSTANTIATE_TEST_SUITE_P(Report, MissingPiece,
                         testing::Values(MissingCase{"summary.json", "has no summary.json"},
                                         MissingCase{"frames.csv",
                                                     "run it again with this version"},
                                         MissingCase{"map.ply", "--set build_semantic_map=true"},
                                         MissingCase{"objects.db", "run with a --segmenter"},
                                         MissingCase{"keyframes", "--set keyframe_images=24"}));

TEST_F(ReportPageTest, NeedsNoTruthVoxelsLiveTrajectoryOrFrameTimes) {
  for (const char* file :
       {"map.ot", "map_labels.csv", "trajectory_live.txt", "times.csv", "keyframes.txt"}) {
    std::filesystem::remove(folder() / file);
  }
  const std::string page = Page();
  EXPECT_THAT(page, AllOf(HasSubstr("There is no ground truth"), HasSubstr("--ground-truth"),
                          HasSubstr("no ground truth to compare with"), Not(HasSubstr("nan,"))));
}

TEST_F(ReportPageTest, OfATrajectoryAloneIsAPage) {
  std::filesystem::rename(folder() / "trajectory.txt", root_.path() / "kept");
  std::filesystem::remove_all(folder());
  std::filesystem::create_directory(folder());
  std::filesystem::rename(root_.path() / "kept", folder() / "trajectory.txt");
  EXPECT_THAT(Page(), AllOf(HasSubstr("id=\"viewer\""), HasSubstr("</h2>")));
  root_.Write("out/trajectory.txt", "");
  EXPECT_THAT(Page(), AllOf(Not(HasSubstr("id=\"viewer\"")), HasSubstr("no frame was tracked")));
}

TEST_F(ReportPageTest, TellsWhyARunEndedEarly) {
  root_.Write("out/summary.json", R"({"error": "7.png: is <damaged>"})");
  EXPECT_THAT(Page(), HasSubstr("out ended early: 7.png: is &lt;damaged&gt;"));
}

TEST_F(ReportPageTest, ComparesRunsSideBySide) {
  test::WriteMadeResults(root_.path() / "other", 0.04);
  const ReportData data =
      LoadReportData({folder(), root_.path() / "other"}, test::WriteMadeTruth(root_.path()));
  const std::string page = ReportPage(data, "9.9");
  EXPECT_THAT(page, AllOf(HasSubstr("All runs side by side"), HasSubstr("card run1"),
                          HasSubstr("<td class=\"best\">"), HasSubstr("out, other")));
}

TEST_F(ReportPageTest, WantsOneToSixFolders) {
  EXPECT_THAT(ErrorOf([] { LoadReportData({}, ""); }), HasSubstr("name a folder"));
  EXPECT_THAT(ErrorOf([&] { LoadReportData(std::vector(7, folder()), ""); }),
              HasSubstr("at most 6 runs"));
}

TEST(Assets, CanStandInAPage) {
  EXPECT_EQ(ViewerScript().find("</script"), std::string_view::npos);
  EXPECT_THAT(std::string(ViewerScript().substr(0, 2000)),
              AllOf(HasSubstr("three.js"), HasSubstr("MIT License")));
  EXPECT_EQ(ReportStyle().find("</style"), std::string_view::npos);
  EXPECT_EQ(PlotStyle().find("var("), std::string_view::npos) << "librsvg has none";
}

}  // namespace
}  // namespace ofm
