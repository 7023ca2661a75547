// ofm-slam render: pictures of maps, as a camera in the room would show them.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/report/map_picture.h"
#include "ofm/report/run_record.h"
#include "png_writer.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "One row for each of --what, one column for each run. The view is that of a frame's camera,\n"
    "--back metres behind it and --above metres over it. The runs' frames are found by the first\n"
    "run's time, so that runs over one recording are seen from one place.\n"
    "Examples:\n"
    "  ofm-slam render out --output map.png\n"
    "  ofm-slam render out --what octree --color label --back 2 --above 1.5 -o octree.png\n"
    "  ofm-slam render out/off out/full --what cloud octree -o with_and_without_culling.png";

constexpr std::size_t kMostPoints = 5'000'000, kMostVoxels = 1'000'000;
constexpr int kTitle_px = 36;

struct RenderArguments {
  std::vector<std::filesystem::path> folders;
  std::vector<std::string> parts = {"cloud"};
  std::filesystem::path output;
  std::string color = "appearance";
  double frame_share = .5;
  double back_m = 1, above_m = .5;
  int width_px = 960;
};

/// The pose next to a time.
const RigidTransform& PoseNear(const Trajectory& trajectory, std::int64_t stamp_ns) {
  const auto distance = [&](const StampedPose& pose) { return std::abs(pose.stamp_ns - stamp_ns); };
  return std::min_element(trajectory.begin(), trajectory.end(),
                          [&](const auto& a, const auto& b) { return distance(a) < distance(b); })
      ->world_from_camera;
}

/// What is drawn is read, and nothing else.
RecordLimits LimitsFor(const std::vector<std::string>& parts) {
  const auto wants = [&](const char* part) {
    return std::ranges::find(parts, part) != parts.end();
  };
  return {wants("cloud") ? kMostPoints : 0, wants("octree") ? kMostVoxels : 0};
}

cv::Mat Draw(const RunRecord& run, const std::string& part, const Viewpoint& viewpoint,
             MapColor color) {
  const auto missing = [&](const char* file) {
    return Error(run.folder,
                 fmt::format("has no {}; run with --set build_semantic_map=true", file));
  };
  if (part == "cloud") {
    if (!run.cloud) throw missing("map.ply");
    return DrawCloud(*run.cloud, viewpoint, color);
  }
  if (!run.voxels) throw missing("map.ot");
  return DrawVoxels(*run.voxels, viewpoint, color);
}

cv::Mat WithTitle(const cv::Mat& picture, const std::string& title) {
  cv::Mat titled;
  cv::copyMakeBorder(picture, titled, kTitle_px, 0, 0, 0, cv::BORDER_CONSTANT,
                     cv::Scalar::all(255));
  cv::putText(titled, title, {8, kTitle_px - 12}, cv::FONT_HERSHEY_SIMPLEX, .6, cv::Scalar::all(0),
              1, cv::LINE_AA);
  return titled;
}

void Render(const RenderArguments& arguments) {
  if (arguments.output.extension() != ".png") {
    throw Error(arguments.output, "name a file that ends in .png");
  }
  std::vector<RunRecord> runs;
  for (const auto& folder : arguments.folders) {
    runs.push_back(LoadRunRecord(folder, LimitsFor(arguments.parts)));
  }
  const std::vector<std::string> names = NamesOf(arguments.folders);
  for (const RunRecord& run : runs) {
    if (run.trajectory.empty()) throw Error(run.folder, "its trajectory.txt has no pose");
  }
  const Trajectory& first = runs.front().trajectory;
  const auto frame =
      static_cast<std::size_t>(arguments.frame_share * static_cast<double>(first.size() - 1));
  const MapColor color = arguments.color == "label" ? MapColor::kLabel : MapColor::kAppearance;
  std::vector<cv::Mat> rows;
  for (const std::string& part : arguments.parts) {
    std::vector<cv::Mat> row;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Viewpoint viewpoint;
      viewpoint.world_from_camera = Overlook(PoseNear(runs[i].trajectory, first[frame].stamp_ns),
                                             arguments.back_m, arguments.above_m);
      viewpoint.size = {arguments.width_px, arguments.width_px * 3 / 4};
      row.push_back(WithTitle(Draw(runs[i], part, viewpoint, color), names[i] + ": " + part));
    }
    cv::hconcat(row, rows.emplace_back());
  }
  cv::Mat picture;
  cv::vconcat(rows, picture);
  WritePng(arguments.output, picture);
  fmt::print("{}\n", arguments.output.string());
}

}  // namespace

void AddRenderCommand(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      app.add_subcommand("render", "Draw the cloud or the octree of one or more runs as a picture");
  command->footer(kFooter);
  command->add_option("OUT", arguments->folders, "Folders that ofm-slam run has written")
      ->required();
  command->add_option("--what", arguments->parts, "cloud, octree or both")
      ->check(CLI::IsMember({"cloud", "octree"}))
      ->capture_default_str();
  command->add_option("--output,-o", arguments->output, "File to write, .png")->required();
  command
      ->add_option("--color", arguments->color,
                   "appearance, or label: what has a class in its colour, the rest paler")
      ->check(CLI::IsMember({"appearance", "label"}))
      ->capture_default_str();
  command
      ->add_option("--at", arguments->frame_share,
                   "Which frame's view: 0 is the run's first, 1 its last")
      ->check(CLI::Range(0., 1.))
      ->capture_default_str();
  command->add_option("--back", arguments->back_m, "Behind that camera [m]")
      ->check(CLI::Range(0., 100.))
      ->capture_default_str();
  command->add_option("--above", arguments->above_m, "Over that camera [m]")
      ->check(CLI::Range(-100., 100.))
      ->capture_default_str();
  command->add_option("--width", arguments->width_px, "Of each view; it is 3/4 as high [px]")
      ->check(CLI::Range(100, 4000))
      ->capture_default_str();
  command->callback([arguments] { Render(*arguments); });
}

}  // namespace ofm
