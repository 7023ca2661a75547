// The report in a real browser: headless Chromium with software rendering.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "test_recording.h"

namespace ofm {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The command of a Chromium; empty where there is none.
std::string FindChromium() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (std::system(("command -v " + std::string(name) + " >/dev/null 2>&1").c_str()) == 0) {
      return name;
    }
  }
  return {};
}

struct BrowserResult {
  int exit_code = -1;
  std::string page;  ///< as it is after its scripts have run
  std::string log;   ///< with what they wrote to the console
};

/// Opens a file with a window of `size` ("900,1200") and writes a picture of it to `screenshot`.
BrowserResult Browse(const std::string& chromium, const std::filesystem::path& file,
                     const std::string& size, const std::filesystem::path& screenshot) {
  const TestFolder folder;
  const std::string out = (folder.path() / "out").string(), log = (folder.path() / "log").string();
  const std::string options =
      " --headless=new --no-sandbox --disable-dev-shm-usage --use-gl=angle "
      "--use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars "
      "--enable-logging=stderr --user-data-dir='" +
      (folder.path() / "profile").string() + "' --window-size=" + size +
      " --virtual-time-budget=4000 --screenshot='" + screenshot.string() + "' --dump-dom ";
  const int status = std::system(("timeout 120 " + chromium + options + "'file://" + file.string() +
                                  "' > '" + out + "' 2> '" + log + "'")
                                     .c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadFile(out), ReadFile(log)};
}

class ReportInABrowser : public testing::Test {
 protected:
  void SetUp() override {
    chromium_ = FindChromium();
    if (chromium_.empty()) {
      GTEST_SKIP() << "no Chromium here (Debian: apt-get install chromium)";
    }
    ASSERT_EQ(recording_.Run("--segmenter masks").exit_code, 0);
    ASSERT_EQ(RunProgram("report '" + recording_.output().string() + "'").exit_code, 0);
  }

  BrowserResult Open(const std::string& size) const {
    return Browse(chromium_, recording_.output() / "report.html", size, screenshot());
  }
  std::filesystem::path screenshot() const { return recording_.root() / "screenshot.png"; }

  TestRecording recording_{12};
  std::string chromium_;
};

TEST_F(ReportInABrowser, DrawsTheMapWithoutAnError) {
  const BrowserResult result = Open("1100,900");
  ASSERT_EQ(result.exit_code, 0) << result.log;
  EXPECT_THAT(result.log, Not(HasSubstr("CONSOLE"))) << "nothing is written to the console";
  std::smatch drawn;
  const std::regex counts("data-drawn=\"([0-9]+) points, ([0-9]+) triangles\"");
  ASSERT_TRUE(std::regex_search(result.page, drawn, counts)) << result.log;
  EXPECT_GT(std::stoi(drawn[1]), 100);
  EXPECT_GT(std::stoi(drawn[2]), 10) << "the trajectory is made of triangles";
  EXPECT_THAT(result.page, HasSubstr("octree</label>"));
  const cv::Mat picture = cv::imread(screenshot().string(), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.cols, 1100);
  cv::Scalar mean, deviation;
  cv::meanStdDev(picture, mean, deviation);
  EXPECT_GT(deviation[0], 5) << "the page is not empty";
}

TEST_F(ReportInABrowser, FitsAPhone) {
  // A page that is wider than its window would be laid out wider: this one says its width itself.
  const auto file = recording_.output() / "report.html";
  std::string page = ReadFile(file);
  page.insert(page.rfind("</body>"),
              "<script>document.documentElement.dataset.width = "
              "document.documentElement.scrollWidth;</script>");
  std::ofstream(file, std::ios::binary) << page;
  const BrowserResult result = Open("500,900");
  ASSERT_EQ(result.exit_code, 0) << result.log;
  EXPECT_THAT(result.page, HasSubstr("data-width=\"500\""));
}

}  // namespace
}  // namespace ofm
