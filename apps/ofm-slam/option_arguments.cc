#include "option_arguments.h"

namespace ofm {

void OptionArguments::AddTo(CLI::App& command) {
  command.add_option("--config", config, "YAML file of settings (see --print-config)");
  command.add_option("--set", assignments, "One setting, e.g. --set features.count=1500")
      ->allow_extra_args(false);
  command.add_option("--seed", seed,
                     "Seed of all random draws: the same seed gives the same files");
  command.add_option("--segmenter", segmenter,
                     "What finds people: none, masks (instance PNGs in the sequence's mask/), "
                     "yolo-seg (ONNX, needs --model)");
  command.add_option("--model", model, "Network for --segmenter yolo-seg");
  command.add_option("--dynamics", dynamics, "What is culled: off, paper");
}

SlamOptions OptionArguments::Resolve() const {
  SlamOptions options;
  const std::vector<OptionField> fields = OptionFields(options);
  if (!config.empty()) LoadOptionsYaml(config, fields);
  const auto apply = [&](const char* key, const std::string& value) {
    if (!value.empty()) ApplyOptionAssignment(std::string(key) + "=" + value, fields);
  };
  apply("perception.segmenter", segmenter);
  apply("perception.model", model);
  apply("dynamics.mode", dynamics);
  if (seed) options.seed = *seed;
  for (const std::string& assignment : assignments) ApplyOptionAssignment(assignment, fields);
  return options;
}

}  // namespace ofm
