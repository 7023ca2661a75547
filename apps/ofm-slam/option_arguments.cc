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
                     "yolo-seg or mask-rcnn (need --model)");
  command.add_option("--model", model,
                     "Network: ONNX, for mask-rcnn also TensorFlow's .pb; see ofm-slam models");
  command.add_option("--model-graph", model_graph,
                     "OpenCV's text graph (.pbtxt) for a .pb; default: the one beside it");
  command.add_option("--dynamics", dynamics, "What is culled: off, paper, full");
  command.add_option(
      "--vocabulary", vocabulary,
      "File by which places are recognised (see ofm-slam vocabulary); default: built in");
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
  apply("perception.model_graph", model_graph);
  apply("dynamics.mode", dynamics);
  apply("vocabulary", vocabulary);
  if (seed) options.seed = *seed;
  for (const std::string& assignment : assignments) ApplyOptionAssignment(assignment, fields);
  return options;
}

}  // namespace ofm
