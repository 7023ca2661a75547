// The page in a browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>

#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"
#include "ofm/pipeline/test_support.h"
#include "ofm/view/live_view.h"

namespace ofm {
namespace {

bool HasChromium() { return std::system("command -v chromium > /dev/null") == 0; }

/// Opens the page, waits for some milliseconds of its time, takes a picture. Returns what the
/// browser wrote to its error stream, the page's console included.
std::string TakeScreenshot(const std::string& url, const std::filesystem::path& folder,
                           int wait_ms) {
  const std::string command =
      "timeout 60 chromium --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader "
      "--enable-unsafe-swiftshader --enable-logging=stderr --window-size=1200,700 "
      "--virtual-time-budget=" +
      std::to_string(wait_ms) + " --user-data-dir='" + (folder / "profile").string() +
      "' --screenshot='" + (folder / "page.png").string() + "' '" + url + "' > /dev/null 2> '" +
      (folder / "log").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return ReadFile(folder / "log");
}

/// Share of the pixels of a part of the picture that are far from grey.
double ColorfulShare(const cv::Mat& image) {
  std::vector<cv::Mat> channels;
  cv::split(image, channels);
  cv::Mat largest, least;
  cv::max(channels[0], cv::Mat(cv::max(channels[1], channels[2])), largest);
  cv::min(channels[0], cv::Mat(cv::min(channels[1], channels[2])), least);
  return cv::countNonZero(largest - least > 25) / static_cast<double>(image.total());
}

TEST(LivePage, ShowsTheFrameAndTheMapWithoutErrors) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed (apt-get install chromium)";
  const test::Recording recording(8);
  LiveViewOptions options;
  options.max_pictures_per_s = options.max_map_updates_per_s = 1e6;
  LiveView view(options, recording.sequence.camera(), {"person"}, 8);
  test::PlaySource source(recording.images);
  const auto slam = test::MakeSlam(recording, test::KeyframesOften());
  RunContext context;
  context.observers.push_back(&view);
  view.ShowMap(RunSequential(*slam, source, context).map);

  const TestFolder folder;
  double frame_share = 0, map_share = 0;
  // A busy machine needs longer: the browser's time goes on while messages are on their way.
  for (const int wait_ms : {5'000, 20'000, 80'000}) {
    const std::string log = TakeScreenshot(view.url(), folder.path(), wait_ms);
    EXPECT_THAT(log, testing::Not(testing::HasSubstr(":CONSOLE"))) << log;
    const cv::Mat page = cv::imread((folder.path() / "page.png").string());
    ASSERT_FALSE(page.empty());
    const int split = page.cols * 2 / 5;
    frame_share = ColorfulShare(page.colRange(0, split));
    map_share = ColorfulShare(page.colRange(split, page.cols));
    if (frame_share > 0.05 && map_share > 0.02) break;
  }
  EXPECT_GT(frame_share, 0.05) << "no frame is shown";
  EXPECT_GT(map_share, 0.02) << "no map is shown";
  if (const char* keep = std::getenv("OFM_KEEP_SCREENSHOTS")) {
    std::filesystem::copy_file(folder.path() / "page.png", std::filesystem::path(keep) / "live.png",
                               std::filesystem::copy_options::overwrite_existing);
  }
}

}  // namespace
}  // namespace ofm
