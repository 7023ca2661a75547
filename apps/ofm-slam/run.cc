// ofm-slam run: a recorded sequence in; trajectory, map and figures out.
#include <fmt/format.h>

#include <csignal>
#include <opencv2/core/utility.hpp>

#include "commands.h"
#include "interrupt.h"
#include "ofm/base/error.h"
#include "option_arguments.h"
#include "run_session.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "Writes to the output folder: trajectory.txt (TUM format, world_from_camera, after\n"
    "optimisation), trajectory_live.txt (as known at the time of each frame), keyframes.txt,\n"
    "map.ply (coloured, labelled cloud), map.ot and map.bt (OctoMap), map_labels.csv,\n"
    "map.pgm and map.yaml (a grid for nav2, where there is a floor),\n"
    "objects.db and objects.json (with a segmenter; see ofm-slam objects),\n"
    "frames.csv and times.csv (state, culled share, CPU time of each frame), keyframes/ (small\n"
    "pictures with masks; 'ofm-slam report' shows them),\n"
    "config.yaml, camera.yaml and summary.json. Frames of parts of the map that were begun after "
    "a\n"
    "loss and never joined to the rest are in trajectory_submap_N.txt, in their own worlds.\n"
    "With groundtruth.txt in the sequence the summary has ATE and RPE. Ctrl-C ends the run early\n"
    "and keeps all results.\n"
    "Examples:\n"
    "  ofm-slam run desk --camera tum-fr1 --output out\n"
    "  ofm-slam run desk_walking --segmenter masks --output out\n"
    "  ofm-slam run desk_walking --segmenter yolo-seg --model yolov8n-seg.onnx --output out\n"
    "  ofm-slam run desk --threaded --set features.count=1500 --seed 3 --output out\n"
    "  ofm-slam run desk --threaded --view\n"
    "  ofm-slam run desk --save-map desk.ofm\n"
    "  ofm-slam run desk_later --load-map desk.ofm --localize-only";

struct RunArguments {
  RunSettings settings;
  OptionArguments options;
  bool print_config = false;
  bool localize_only = false;
};

void Run(RunArguments& arguments) {
  // One stage per thread; libraries do not start their own.
  cv::setNumThreads(1);
  arguments.settings.options = arguments.options.Resolve();
  if (arguments.print_config) {
    fmt::print("{}", PrintOptionsYaml(OptionFields(arguments.settings.options)));
    return;
  }
  if (arguments.localize_only) arguments.settings.options.localize_only = true;
  if (arguments.settings.sequence.empty()) throw Error("name a SEQUENCE folder to run on");
  const InterruptStop interrupt;
  const RunReport report = RunSession(arguments.settings, interrupt.token());
  fmt::print("{}results in {}\n", FormatSummary(report), arguments.settings.output.string());
  if (!report.outcome.error.empty()) {
    throw Error(report.outcome.error + " (results up to there are in " +
                arguments.settings.output.string() + ")");
  }
}

}  // namespace

void AddRunCommand(CLI::App& app) {
  auto arguments = std::make_shared<RunArguments>();
  RunSettings& settings = arguments->settings;
  settings.output = "out";
  CLI::App* command = app.add_subcommand("run", "Track a camera and map a room from a recording");
  command->footer(kFooter);
  command->add_option("SEQUENCE", settings.sequence, "Folder in the TUM RGB-D layout");
  command->add_option("--output,-o", settings.output, "Folder for the results")
      ->capture_default_str();
  command
      ->add_option("--camera", settings.camera,
                   "tum-fr1, tum-fr2, tum-fr3, a YAML or JSON file, or auto (the sequence's own)")
      ->capture_default_str();
  arguments->options.AddTo(*command);
  command->add_flag("--threaded", settings.threaded,
                    "Mapping in a thread of its own (not reproducible to the byte)");
  command->add_flag("--realtime", settings.realtime,
                    "Play at the recorded pace, threaded, and drop frames that cannot wait");
  command
      ->add_option("--realtime-queue", settings.realtime_queue,
                   "Frames that wait while one is worked on; of more the oldest are dropped")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--true-masks", settings.true_masks,
                      "Folder of true instance masks (PNG): culling is measured against them");
  command->add_option("--write-masks", settings.write_masks,
                      "Folder for each frame's instances (JSON), which --segmenter masks reads: a\n"
                      "slow network then runs once for many runs");
  CLI::Option* inpainted = command->add_option(
      "--write-inpainted", settings.write_inpainted,
      "Folder for the frames without what moved in them: a TUM folder whose hidden\n"
      "colour and depth are filled from the keyframes before and after");
  CLI::Option* view = command->add_flag(
      "--view", settings.view,
      "Show the run in a browser while it goes on: frame, masks, features, growing map");
  command->add_option("--view-port", settings.view_server.port, "Port of the view; 0 = any")
      ->needs(view)
      ->capture_default_str();
  command
      ->add_option("--view-address", settings.view_server.address,
                   "Address that the view listens on: 127.0.0.1 is this machine alone, 0.0.0.0\n"
                   "shows it to everyone who can reach this machine")
      ->needs(view)
      ->capture_default_str();
  command->add_option("--debug-video", settings.debug_video,
                      "FILE.avi or folder: masks, flow, dynamic and static points of every frame");
  CLI::Option* load = command->add_option("--load-map", settings.load_map,
                                          "Map file of an earlier run to go on with");
  CLI::Option* save =
      command->add_option("--save-map", settings.save_map,
                          "Map file to write at the end, for --load-map; may replace an older one");
  command
      ->add_flag("--localize-only", arguments->localize_only,
                 "Only follow the camera in the loaded map, which stays as it is")
      ->needs(load)
      ->excludes(save)
      ->excludes(inpainted);
  command->add_option("--start", settings.range.first, "First frame")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--frames", settings.range.max_count, "Frames at most")
      ->check(CLI::PositiveNumber);
  command->add_flag("--quiet", settings.quiet, "No progress bar");
  command->add_flag("--print-config", arguments->print_config,
                    "Print all settings with their documentation and end");
  command->callback([arguments] { Run(*arguments); });
}

}  // namespace ofm
