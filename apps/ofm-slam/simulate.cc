// ofm-slam simulate: a recording of a made world, with everything known about it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/base/timing.h"
#include "ofm/io/make_folder.h"
#include "simulated_recording.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "Writes a TUM RGB-D folder: rgb/, depth/, rgb.txt, depth.txt, groundtruth.txt, camera.json,\n"
    "actors.json and mask/. A mask's PNG has the numbers of what moves (0 = static), its JSON the\n"
    "instances that a perfect network would find, with COCO's class names, for --segmenter masks.\n"
    "The same arguments give the same bytes.\n"
    "Examples:\n"
    "  ofm-slam simulate walking_xyz --path xyz --noise kinect\n"
    "  ofm-slam run walking_xyz --segmenter masks --output out\n"
    "  ofm-slam evaluate out/trajectory.txt walking_xyz/groundtruth.txt\n"
    "The same way of the camera with nobody there, to compare with:\n"
    "  ofm-slam simulate static_xyz --path xyz --noise kinect --people none\n"
    "All settings (--set): ofm-slam simulate --print-config";

struct SimulateArguments {
  std::filesystem::path output;
  std::string scene = "office", people = "walking", path, noise, size = "640x480";
  std::vector<double> distortion;
  int frames = 300, threads = 0;
  double rate_hz = 30;
  std::uint64_t seed = 1;
  bool blur = false, exposure = false, flow = false, quiet = false, print_config = false;
  std::vector<std::string> assignments;
};

/// A camera for "WIDTHxHEIGHT".
PinholeCamera ParseSize(const std::string& size) {
  constexpr int kLeast = 64, kMost = 4096;
  int width = 0, height = 0, end = 0;
  if (std::sscanf(size.c_str(), "%dx%d%n", &width, &height, &end) != 2 ||
      end != static_cast<int>(size.size()) || std::min(width, height) < kLeast ||
      std::max(width, height) > kMost) {
    throw Error(fmt::format("--size {}: give WIDTHxHEIGHT, each from {} to {} px, as in 640x480",
                            size, kLeast, kMost));
  }
  return MakeSimCamera(width, height);
}

void SetDistortion(const std::vector<double>& coefficients, PinholeCamera& camera) {
  const std::array<double*, 5> fields = {&camera.k1, &camera.k2, &camera.p1, &camera.p2,
                                         &camera.k3};
  for (std::size_t i = 0; i < coefficients.size(); ++i) *fields[i] = coefficients[i];
}

SimSequenceOptions ResolveOptions(const SimulateArguments& arguments) {
  SimSequenceOptions options = HandHeldOptions();
  options.seed = arguments.seed;
  options.frames = arguments.frames;
  options.rate_hz = arguments.rate_hz;
  options.camera = ParseSize(arguments.size);
  SetDistortion(arguments.distortion, options.camera);
  if (arguments.blur) options.imaging.exposure_s = 0.015;
  if (arguments.exposure) options.imaging.exposure_swing = 0.6;
  const std::vector<OptionField> fields = OptionFields(options);
  const auto apply = [&](const char* key, const std::string& value) {
    if (!value.empty()) ApplyOptionAssignment(std::string(key) + "=" + value, fields);
  };
  apply("world.scene", arguments.scene);
  apply("world.people", arguments.people);
  apply("path.kind", arguments.path);
  apply("noise.model", arguments.noise);
  for (const std::string& assignment : arguments.assignments) {
    ApplyOptionAssignment(assignment, fields);
  }
  return options;
}

/// Makes the folder. Throws Error where it has something in it already or cannot be made.
void MakeNewFolder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_empty(folder, error)) {
    throw Error(folder, "exists and is not empty; choose another folder or remove it");
  }
  MakeFolder(folder);
}

void PrintSummary(const SimulateArguments& arguments, const SimSequence& sequence,
                  double elapsed_s) {
  fmt::print("{}: {} frames of {} x {} px in {:.1f} s, {:.1f} frames/s\n",
             arguments.output.string(), arguments.frames, sequence.camera().width,
             sequence.camera().height, elapsed_s, arguments.frames / elapsed_s);
}

void Simulate(const SimulateArguments& arguments) {
  SimSequenceOptions options = ResolveOptions(arguments);
  if (arguments.print_config) {
    fmt::print("{}", PrintOptionsYaml(OptionFields(options)));
    return;
  }
  if (arguments.output.empty()) throw Error("OUT is required: the folder to write");
  MakeNewFolder(arguments.output);
  cv::setNumThreads(1);  // the frames are in threads already
  const std::int64_t start_ns = SteadyTimeNs();
  const SimSequence sequence(options);
  WriteRecording(
      sequence, arguments.output,
      {arguments.flow ? FlowFiles::kWrite : FlowFiles::kNone, arguments.threads, arguments.quiet});
  PrintSummary(arguments, sequence, 1e-9 * static_cast<double>(SteadyTimeNs() - start_ns));
}

}  // namespace

void AddSimulateCommand(CLI::App& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  SimulateArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "simulate", "Write a recording of a made world: colour, depth, masks, poses");
  command->footer(kFooter);
  command->add_option("OUT", a.output, "Folder to write; must be new or empty");
  command
      ->add_option("--scene", a.scene,
                   "The world: office, corridor (with three rooms) or room (small, for tests)")
      ->capture_default_str();
  command->add_option("--people", a.people, "What people do: walking, sitting or none")
      ->capture_default_str();
  command->add_option("--path", a.path,
                      "How the camera moves: static, xyz, rpy, halfsphere or tour (closes a loop)");
  command->add_option("--frames", a.frames, "Frames to write")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--fps", a.rate_hz, "Frames per second")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  command->add_option("--size", a.size, "Of the images [px]")->capture_default_str();
  command->add_option("--seed", a.seed, "Another seed is another world")->capture_default_str();
  command->add_option("--noise", a.noise,
                      "none, or kinect: depth with noise, steps, holes, shadows and a range");
  command->add_flag("--blur", a.blur, "Motion blur, of a shutter that is open for 15 ms");
  command->add_flag("--exposure", a.exposure, "Brightness that goes up and down by 0.6 stops");
  command
      ->add_option("--distortion", a.distortion,
                   "K1,K2,P1,P2,K3 of the lens (Brown-Conrady), the last ones may be left out")
      ->delimiter(',')
      ->expected(1, 5);
  command->add_flag("--flow", a.flow, "Write true optical flow too: flow/, KITTI's 16-bit PNGs");
  command->add_option("--threads", a.threads, "0: one for each core")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  command->add_option("--set", a.assignments, "One setting, e.g. --set path.period_s=9")
      ->allow_extra_args(false);
  command->add_flag("--print-config", a.print_config, "Print all settings as YAML, and end");
  command->add_flag("--quiet", a.quiet, "No progress bar");
  command->callback([arguments] { Simulate(*arguments); });
}

}  // namespace ofm
