// ofm-slam plot: a report's plots as files.
#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/report/figures.h"
#include "ofm/report/report_page.h"
#include "rasterize.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "Kinds: plan (trajectories from above), xyz (over time), ate and rpe (errors over time),\n"
    "timing (CPU by stage and frame), culled (masked share over time), map (semantic map from\n"
    "above). They are those of 'ofm-slam report', on white. Errors need ground truth:\n"
    "--ground-truth, or the groundtruth.txt of the run's input folder.\n"
    "Examples:\n"
    "  ofm-slam plot out --kind plan --output plan.svg\n"
    "  ofm-slam plot out/full out/off --kind ate --ground-truth desk/groundtruth.txt -o ate.png";

struct PlotArguments {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path ground_truth, output;
  std::string kind = "plan";
  int width_px = 1440;
};

void MakePlot(const PlotArguments& arguments) {
  const std::filesystem::path extension = arguments.output.extension();
  if (extension != ".svg" && extension != ".png") {
    throw Error(arguments.output, "name a file that ends in .svg or .png");
  }
  const FigureKind kind = ParseFigureKind(arguments.kind).value();
  RecordLimits limits;
  if (kind == FigureKind::kMap) limits.points = 2 * kReportLimits.points;
  const ReportData data = LoadReportData(arguments.folders, arguments.ground_truth, limits);
  const std::string svg = FigureToSvg(MakeFigure(kind, data));
  WriteFileAtomically(arguments.output,
                      extension == ".svg" ? svg : RasterizeSvg(svg, arguments.width_px));
  fmt::print("{}\n", arguments.output.string());
}

}  // namespace

void AddPlotCommand(CLI::App& app) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* command = app.add_subcommand("plot", "Draw one plot of one or more runs");
  command->footer(kFooter);
  command->add_option("OUT", arguments->folders, "Folders that ofm-slam run has written")
      ->required();
  command->add_option("--kind,-k", arguments->kind, "What to plot")
      ->check(CLI::IsMember(FigureKindNames()))
      ->capture_default_str();
  command->add_option("--output,-o", arguments->output, "File to write, .svg or .png")->required();
  command->add_option("--ground-truth", arguments->ground_truth,
                      "True trajectory, lines 'timestamp tx ty tz qx qy qz qw' [s, m]");
  command->add_option("--width", arguments->width_px, "Of a PNG [px]")
      ->check(CLI::Range(100, 10000))
      ->capture_default_str();
  command->callback([arguments] { MakePlot(*arguments); });
}

}  // namespace ofm
