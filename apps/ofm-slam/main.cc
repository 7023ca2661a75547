// The program: reads the command line, runs one subcommand, reports errors in one line.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <string>

#include "commands.h"
#include "ofm/base/error.h"

namespace {

constexpr const char* kDescription =
    "RGB-D SLAM and semantic mapping in rooms where people walk about";

constexpr const char* kExamples =
    "Examples:\n"
    "  ofm-slam demo\n"
    "  ofm-slam run desk --camera tum-fr1 --output out\n"
    "  ofm-slam evaluate out/trajectory.txt desk/groundtruth.txt --sequence desk\n"
    "  ofm-slam report out\n"
    "  ofm-slam run --help";

void LogToStderr() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("ofm-slam"));
  // OpenCV logs what it also throws, and an error is one line here.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

/// Parses the arguments, which also runs the subcommand that they name.
int RunCommandLine(int argc, char** argv) {
  CLI::App app(kDescription, "ofm-slam");
  app.footer(kExamples);
  app.set_version_flag("--version", "ofm-slam " OFM_VERSION);
  app.require_subcommand(0, 1);  // none is reported below: CLI11 would hide a misspelt one
  ofm::AddRunCommand(app);
  ofm::AddEvaluateCommand(app);
  ofm::AddEvaluateMapCommand(app);
  ofm::AddEvaluateInpaintingCommand(app);
  ofm::AddMapCommand(app);
  ofm::AddObjectsCommand(app);
  ofm::AddReportCommand(app);
  ofm::AddPlotCommand(app);
  ofm::AddRenderCommand(app);
  ofm::AddDemoCommand(app);
  ofm::AddSimulateCommand(app);
  ofm::AddModelsCommand(app);
  ofm::AddVocabularyCommand(app);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    throw ofm::Error(std::string(error.what()) + "; see ofm-slam --help");
  }
  if (!std::cout.flush() || std::fflush(stdout) != 0) {
    throw ofm::Error("the output cannot be written");
  }
  return 0;
}

int Fail(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "ofm-slam: error: %s\n", message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a write over the limit then fails like any other
  try {
    LogToStderr();
    return RunCommandLine(argc, argv);
  } catch (const std::exception& error) {
    return Fail(error.what());
  }
}
