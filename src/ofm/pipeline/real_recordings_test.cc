// The whole system on recordings of a real camera, where they are at hand.
#include <gtest/gtest.h>

#include <thread>

#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"
#include "ofm/io/tum_sequence.h"
#include "ofm/perception/null_segmenter.h"
#include "ofm/pipeline/result_writer.h"
#include "ofm/pipeline/runner.h"

namespace ofm {
namespace {

const std::filesystem::path kDesk = OFM_SHARED_DIR "/data/tum_fr1_desk";
const std::filesystem::path kXyz = OFM_SHARED_DIR "/data/tum_fr1_xyz_240";

/// Runs the first frames of a recording with the defaults and leaves its results in `output`.
void RunInto(const std::filesystem::path& output, const std::filesystem::path& recording) {
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  TumFrameSource source(std::make_shared<RgbdSequence>(recording, camera), {0, 30});
  const SlamOptions options;
  Slam slam(camera, options, std::make_unique<NullSegmenter>());
  RunDescription description;
  description.camera = camera;
  WriteResults(output, RunSequential(slam, source, {}), options, description);
}

void ExpectSameResults(const TestFolder& first, const TestFolder& second) {
  std::size_t compared = 0;
  for (const auto& entry : std::filesystem::directory_iterator(first.path())) {
    const std::filesystem::path name = entry.path().filename();
    if (name == "summary.json" || name == "times.csv") continue;  // has times
    EXPECT_TRUE(ReadFile(entry.path()) == ReadFile(second.path() / name)) << name;
    ++compared;
  }
  EXPECT_GE(compared, 9U);
}

TEST(RealRecordings, TwoAtOnceGiveTheBytesOfOneAfterTheOther) {
  for (const auto& recording : {kDesk, kXyz})
    if (!std::filesystem::exists(recording)) GTEST_SKIP() << "needs " << recording;
  const TestFolder desk, xyz, desk_at_once, xyz_at_once;
  RunInto(desk.path(), kDesk);
  RunInto(xyz.path(), kXyz);
  {
    std::jthread a([&] { RunInto(desk_at_once.path(), kDesk); });
    std::jthread b([&] { RunInto(xyz_at_once.path(), kXyz); });
  }
  ExpectSameResults(desk, desk_at_once);
  ExpectSameResults(xyz, xyz_at_once);
}

}  // namespace
}  // namespace ofm
