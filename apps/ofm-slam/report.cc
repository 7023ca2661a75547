// ofm-slam report: one page about one or more runs.
#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "ofm/io/atomic_file.h"
#include "ofm/report/report_page.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "The page is one file that needs no connection: trajectory from above and over time, errors\n"
    "over time, culled share, key frames with masks, the labelled map in 3-D and from above,\n"
    "objects, times by stage; two or more runs side by side, each in a colour. What a folder "
    "lacks\n"
    "is said on the page. Without --ground-truth the groundtruth.txt of the run's input folder is\n"
    "taken, where it is still there.\n"
    "Examples:\n"
    "  ofm-slam report out\n"
    "  ofm-slam report out/full out/off --ground-truth desk/groundtruth.txt --output both.html";

struct ReportArguments {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path ground_truth, output;
};

void Report(const ReportArguments& arguments) {
  const std::filesystem::path output =
      arguments.output.empty() ? arguments.folders.front() / "report.html" : arguments.output;
  const ReportData data = LoadReportData(arguments.folders, arguments.ground_truth);
  const std::string page = ReportPage(data, OFM_VERSION);
  WriteFileAtomically(output, page);
  fmt::print("{}: {:.1f} MB; open it in a browser\n", output.string(),
             1e-6 * static_cast<double>(page.size()));
}

}  // namespace

void AddReportCommand(CLI::App& app) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Make one HTML page of one or more runs");
  command->footer(kFooter);
  command->add_option("OUT", arguments->folders, "Folders that ofm-slam run has written")
      ->required();
  command->add_option("--ground-truth", arguments->ground_truth,
                      "True trajectory, lines 'timestamp tx ty tz qx qy qz qw' [s, m]");
  command->add_option("--output,-o", arguments->output,
                      "File to write; report.html in the first folder unless given");
  command->callback([arguments] { Report(*arguments); });
}

}  // namespace ofm
