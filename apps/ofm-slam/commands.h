// The subcommands, one file each: a function that adds the command to the program.
#pragma once

#include <CLI/CLI.hpp>

namespace ofm {

void AddRunCommand(CLI::App& app);
void AddEvaluateCommand(CLI::App& app);
void AddEvaluateMapCommand(CLI::App& app);
void AddEvaluateInpaintingCommand(CLI::App& app);
void AddMapCommand(CLI::App& app);
void AddObjectsCommand(CLI::App& app);
void AddReportCommand(CLI::App& app);
void AddPlotCommand(CLI::App& app);
void AddRenderCommand(CLI::App& app);
void AddDemoCommand(CLI::App& app);
void AddSimulateCommand(CLI::App& app);
void AddModelsCommand(CLI::App& app);
void AddVocabularyCommand(CLI::App& app);

}  // namespace ofm
