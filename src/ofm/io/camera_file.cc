#include "ofm/io/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

using nlohmann::json;

constexpr const char* kChoices =
    "give tum-fr1, tum-fr2, tum-fr3, a camera file (.yaml or .json), or auto for the camera.json "
    "or camera.yaml beside the sequence";
constexpr std::array kDistortionKeys = {"k1", "k2", "p1", "p2", "k3"};

/// A camera whose required fields hold what no file can set.
PinholeCamera UnsetCamera() {
  constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
  PinholeCamera camera;
  camera.width = camera.height = 0;
  camera.fx = camera.fy = camera.cx = camera.cy = kUnset;
  return camera;
}

void RequireComplete(const PinholeCamera& camera, const std::filesystem::path& path) {
  std::string missing;
  const auto require = [&](bool is_set, const char* key) {
    if (!is_set) missing += fmt::format("{}{}", missing.empty() ? "" : ", ", key);
  };
  require(camera.width != 0, "width");
  require(camera.height != 0, "height");
  require(!std::isnan(camera.fx), "fx");
  require(!std::isnan(camera.fy), "fy");
  require(!std::isnan(camera.cx), "cx");
  require(!std::isnan(camera.cy), "cy");
  if (!missing.empty()) throw Error(path, fmt::format("has no {}; add it", missing));
}

/// The line, from 1, of the byte at `offset`.
int LineOf(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

json ParseJson(const std::filesystem::path& path, const std::string& text) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const std::size_t offset = error.byte > 0 ? error.byte - 1 : 0;
    throw Error(path, LineOf(text, offset), "is not valid JSON");
  }
}

void SetField(const std::vector<OptionField>& fields, const std::string& key, const json& value) {
  const auto field = std::find_if(fields.begin(), fields.end(),
                                  [&](const OptionField& f) { return f.path == key; });
  if (field == fields.end()) throw Error("unknown key");
  if (!value.is_number()) throw Error(fmt::format("{} is no number", value.dump()));
  field->parse(value.dump());
}

void SetDistortion(const std::vector<OptionField>& fields, const json& values) {
  if (!values.is_array() || (values.size() != 4 && values.size() != 5)) {
    throw Error("must be a list [k1, k2, p1, p2, k3]");
  }
  for (std::size_t i = 0; i < values.size(); ++i) SetField(fields, kDistortionKeys[i], values[i]);
}

void LoadJson(const std::filesystem::path& path, const std::vector<OptionField>& fields) {
  const std::string text = ReadFile(path);
  const json root = ParseJson(path, text);
  if (!root.is_object()) throw Error(path, 1, "must hold an object {\"width\": 640, ...}");
  for (const auto& [key, value] : root.items()) {
    try {
      if (key == "distortion") {
        SetDistortion(fields, value);
      } else {
        SetField(fields, key, value);
      }
    } catch (const Error& error) {
      const int line = LineOf(text, text.find(json(key).dump()));
      throw Error(path, line, fmt::format("{}: {}", key, error.what()));
    }
  }
}

}  // namespace

PinholeCamera LoadCamera(const std::filesystem::path& path) {
  PinholeCamera camera = UnsetCamera();
  if (path.extension() == ".json") {
    LoadJson(path, OptionFields(camera));
  } else {
    LoadOptionsYaml(path, OptionFields(camera));
  }
  RequireComplete(camera, path);
  return camera;
}

PinholeCamera ResolveCamera(const std::string& name_or_path,
                            const std::filesystem::path& sequence_folder) {
  if (name_or_path == "auto") {
    for (const char* name : {"camera.json", "camera.yaml"}) {
      const std::filesystem::path path = sequence_folder / name;
      if (std::filesystem::exists(path)) return LoadCamera(path);
    }
    throw Error(sequence_folder,
                fmt::format("has neither camera.json nor camera.yaml; {}", kChoices));
  }
  if (const auto preset = FindCameraPreset(name_or_path)) return *preset;
  if (std::filesystem::exists(name_or_path)) return LoadCamera(name_or_path);
  throw Error(fmt::format("'{}' is neither a known camera nor a file; {}", name_or_path, kChoices));
}

}  // namespace ofm
