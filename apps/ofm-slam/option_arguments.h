// Settings on the command line: a configuration file, single values, and short cuts for the common
// ones.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "ofm/pipeline/options.h"

namespace ofm {

/// Arguments that change SlamOptions; the file first, then the short cuts, then --set.
struct OptionArguments {
  std::string config, segmenter, model, model_graph, dynamics, vocabulary;
  std::vector<std::string> assignments;
  std::optional<std::uint64_t> seed;

  void AddTo(CLI::App& command);
  /// Throws Error that names the file and line, or the assignment.
  SlamOptions Resolve() const;
};

}  // namespace ofm
