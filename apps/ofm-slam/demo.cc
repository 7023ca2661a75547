// ofm-slam demo: a simulated room with people in the way, run with culling and without it.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <string>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/report/report_page.h"
#include "run_session.h"
#include "simulated_recording.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "Simulates a camera in an office in which people walk about, and tracks it twice: with the\n"
    "people culled by their masks and by what moves, and with nothing culled. Needs no data,\n"
    "network or connection. report.html compares both runs. The recording is a TUM RGB-D folder\n"
    "with ground truth and masks, as 'ofm-slam simulate' makes it, good for 'ofm-slam run'.\n"
    "Examples:\n"
    "  ofm-slam demo\n"
    "  ofm-slam demo --output out/other_room --seed 5 --frames 100\n"
    "  ofm-slam run out/demo/sequence --segmenter masks --threaded --output out/again";

struct DemoArguments {
  std::filesystem::path output = "out/demo";
  int frames = 200;
  std::uint64_t seed = 3;
  bool quiet = false;
};

SimSequenceOptions DemoSequence(const DemoArguments& arguments) {
  SimSequenceOptions options = HandHeldOptions();
  options.seed = arguments.seed;
  options.frames = arguments.frames;
  options.camera = MakeSimCamera(640, 480);
  options.world.scene = SceneKind::kOffice;
  options.world.people = PeopleKind::kWalking;
  options.path.kind = CameraPathKind::kHalfsphere;
  options.noise.model = NoiseModel::kKinect;
  return options;
}

RunReport RunDemo(const DemoArguments& arguments, const char* name, DynamicsMode mode) {
  if (!arguments.quiet) fmt::print(stderr, "{}\n", name);
  RunSettings settings;
  settings.sequence = arguments.output / "sequence";
  settings.output = arguments.output / name;
  settings.quiet = arguments.quiet;
  settings.options.seed = arguments.seed;
  settings.options.dynamics.mode = mode;
  settings.options.perception.segmenter = SegmenterKind::kMasks;  // for labels, if not to cull
  RunReport report = RunSession(settings);
  if (!report.outcome.error.empty()) throw Error(report.outcome.error);
  return report;
}

/// A row of the table: what it shows of each run.
template <class Show>
void PrintRow(const char* title, const std::array<RunReport, 2>& reports, Show&& show) {
  fmt::print("{:<26}{:>16}{:>18}\n", title, show(reports[0]), show(reports[1]));
}

/// A row of errors against ground truth, in centimetres.
template <class Get>
void PrintErrors(const char* title, const std::array<RunReport, 2>& reports, Get&& get) {
  PrintRow(title, reports, [&](const RunReport& report) {
    const auto& evaluation = report.description.evaluation;
    return evaluation ? fmt::format("{:.2f} cm", 100 * get(*evaluation)) : std::string("none");
  });
}

void PrintTable(const std::array<RunReport, 2>& reports) {
  fmt::print("{:<26}{:>16}{:>18}\n", "", "with culling", "without culling");
  PrintRow("frames tracked", reports, [](const RunReport& report) {
    const RunCounts& counts = report.outcome.counts;
    return fmt::format("{} of {}", counts.frames_tracked, counts.frames);
  });
  PrintErrors("ATE rmse", reports,
              [](const TrajectoryEvaluation& e) { return e.ate.translation_m.rmse; });
  PrintErrors("ATE max", reports,
              [](const TrajectoryEvaluation& e) { return e.ate.translation_m.max; });
  PrintErrors("RPE rmse per frame", reports,
              [](const TrajectoryEvaluation& e) { return e.rpe_per_frame.translation_m.rmse; });
  PrintErrors("RPE rmse per second", reports,
              [](const TrajectoryEvaluation& e) { return e.rpe_1s.translation_m.rmse; });
  PrintRow("pixels masked", reports, [](const RunReport& report) {
    return fmt::format("{:.1f} %", 100 * report.outcome.counts.mean_masked_share);
  });
  PrintRow("time", reports,
           [](const RunReport& report) { return fmt::format("{:.1f} s", report.outcome.wall_s); });
}

/// Compares both runs; gives the file.
std::filesystem::path WriteReport(const std::filesystem::path& output) {
  const std::filesystem::path file = output / "report.html";
  const ReportData data = LoadReportData({output / "with_culling", output / "without_culling"},
                                         output / "sequence" / "groundtruth.txt");
  WriteFileAtomically(file, ReportPage(data, OFM_VERSION));
  return file;
}

void Demo(const DemoArguments& arguments) {
  cv::setNumThreads(1);  // as in run
  PrepareOutputFolder(arguments.output);
  fmt::print("simulating {} frames of an office with people in the way (seed {})\n",
             arguments.frames, arguments.seed);
  std::fflush(stdout);
  WriteRecording(SimSequence(DemoSequence(arguments)), arguments.output / "sequence",
                 {.quiet = arguments.quiet});
  const std::array reports = {RunDemo(arguments, "with_culling", DynamicsMode::kFull),
                              RunDemo(arguments, "without_culling", DynamicsMode::kOff)};
  fmt::print("\n");
  PrintTable(reports);
  const std::filesystem::path report = WriteReport(arguments.output);
  const std::string folder = arguments.output.string();
  fmt::print(
      "\nATE: error of the positions after alignment to the truth; RPE: error of the motion\n"
      "{0}/sequence         the recording, with ground truth and masks\n"
      "{0}/with_culling     trajectory, map and figures with the people culled\n"
      "{0}/without_culling  the same with nothing culled\n"
      "\nOpen this in a browser: {1}\n",
      folder, report.string());
}

}  // namespace

void AddDemoCommand(CLI::App& app) {
  auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command =
      app.add_subcommand("demo", "Simulate an office with people; track with and without culling");
  command->footer(kFooter);
  command->add_option("--output,-o", arguments->output, "Folder for the recording and the results")
      ->capture_default_str();
  command->add_option("--frames", arguments->frames, "Frames to simulate, at 30 a second")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Another seed is another office with other people")
      ->capture_default_str();
  command->add_flag("--quiet", arguments->quiet, "No progress bar");
  command->callback([arguments] { Demo(*arguments); });
}

}  // namespace ofm
