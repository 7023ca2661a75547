#include "ofm/report/run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

using Json = nlohmann::ordered_json;

Json ParseJson(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = static_cast<int>(1 + std::count(text.begin(), end, '\n'));
    throw Error(path, line, "is no JSON that ofm-slam run wrote; run again");
  }
}

/// Reads values by their place, "counts/frames"; what is missing or null is left as it is.
class JsonReader {
 public:
  JsonReader(const std::filesystem::path& path, const Json& json) : path_(path), json_(json) {}

  template <class T>
  void Read(const char* place, T& value) const {
    const Json::json_pointer pointer{std::string("/") + place};
    // contains() throws where the way leads through a list.
    try {
      if (!json_.contains(pointer) || json_.at(pointer).is_null()) return;
      value = json_.at(pointer).get<T>();
    } catch (const Json::exception&) {
      throw Error(path_, fmt::format("has no fitting value for '{}'", place));
    }
  }
  void Read(const char* place, std::optional<double>& value) const {
    double number = std::numeric_limits<double>::quiet_NaN();
    Read(place, number);
    if (!std::isnan(number)) value = number;
  }

 private:
  const std::filesystem::path& path_;
  const Json& json_;
};

std::vector<StageSummary> ReadStages(const std::filesystem::path& path, const Json& json) {
  std::vector<StageSummary> stages;
  const auto found = json.find("stages");
  if (found == json.end()) return stages;
  if (!found->is_object()) throw Error(path, "has no fitting value for 'stages'");
  for (const auto& [name, times] : found->items()) {
    StageSummary stage;
    stage.name = name;
    const JsonReader reader(path, times);
    reader.Read("cpu/count", stage.count);
    reader.Read("cpu/median_ms", stage.median_ms);
    reader.Read("cpu/p99_ms", stage.p99_ms);
    reader.Read("cpu/max_ms", stage.max_ms);
    stages.push_back(stage);
  }
  return stages;
}

}  // namespace

RunSummary LoadRunSummary(const std::filesystem::path& path) {
  const Json json = ParseJson(path);
  if (!json.is_object()) throw Error(path, 1, "is no JSON that ofm-slam run wrote; run again");
  const JsonReader reader(path, json);
  RunSummary summary;
  reader.Read("version", summary.version);
  reader.Read("input", summary.input);
  reader.Read("runner", summary.runner);
  reader.Read("error", summary.error);
  reader.Read("seed", summary.seed);
  reader.Read("counts/frames", summary.frames);
  reader.Read("counts/frames_tracked", summary.frames_tracked);
  reader.Read("counts/losses", summary.losses);
  reader.Read("counts/keyframes", summary.keyframes);
  reader.Read("counts/landmarks", summary.landmarks);
  reader.Read("counts/mean_masked_share", summary.mean_masked_share);
  reader.Read("loops/closed", summary.loops_closed);
  Json unjoined;
  reader.Read("submaps/unjoined", unjoined);
  summary.submaps_unjoined = unjoined.size();
  reader.Read("wall_s", summary.wall_s);
  reader.Read("process_cpu_s", summary.process_cpu_s);
  reader.Read("peak_memory_mib", summary.peak_memory_mib);
  reader.Read("trajectory/ate/translation_m/rmse", summary.ate_rmse_m);
  reader.Read("trajectory_live/ate/translation_m/rmse", summary.live_ate_rmse_m);
  summary.stages = ReadStages(path, json);
  return summary;
}

}  // namespace ofm
