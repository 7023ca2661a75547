// ofm-slam map: what is in a map file.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "ofm/base/time.h"
#include "ofm/map/map_file.h"
#include "ofm/map/submap.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "Map files are made by ofm-slam run --save-map and used by --load-map. The command also "
    "checks\n"
    "that every byte of the file is as it was written.\n"
    "Example:\n"
    "  ofm-slam map info desk.ofm";

void PrintTimes(const MapSnapshot& map) {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max(), last_ns = 0;
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    first_ns = std::min(first_ns, keyframe.stamp_ns);
    last_ns = std::max(last_ns, keyframe.stamp_ns);
  });
  fmt::print("times      {} to {} s ({:.1f} s)\n", FormatSeconds(first_ns), FormatSeconds(last_ns),
             NanosecondsToSeconds(last_ns - first_ns));
}

void PrintInfo(const std::filesystem::path& path) {
  const StoredMap stored = LoadMap(path);
  const PinholeCamera& camera = stored.settings.camera;
  fmt::print("map        {}, version {}, {:.1f} MB\n", path.string(), kMapFileVersion,
             1e-6 * static_cast<double>(std::filesystem::file_size(path)));
  fmt::print("keyframes  {}\n", stored.map->keyframe_count);
  fmt::print("landmarks  {}\n", stored.map->landmark_count);
  const std::vector<SubmapSize> submaps = FindSubmaps(*stored.map);
  for (const SubmapSize& submap : submaps) {
    if (submaps.size() == 1) continue;
    fmt::print("sub-map    {}: {} keyframes\n", submap.id.value, submap.keyframes);
  }
  PrintTimes(*stored.map);
  fmt::print("camera     {} x {} px, fx {} fy {} cx {} cy {}, {}\n", camera.width, camera.height,
             camera.fx, camera.fy, camera.cx, camera.cy,
             camera.HasDistortion() ? fmt::format("k1 {} k2 {} p1 {} p2 {} k3 {}", camera.k1,
                                                  camera.k2, camera.p1, camera.p2, camera.k3)
                                    : "no distortion");
  fmt::print("features   {} levels, {} apart\n", stored.settings.levels,
             stored.settings.scale_factor);
}

}  // namespace

void AddMapCommand(CLI::App& app) {
  auto path = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand("map", "Look into map files");
  command->require_subcommand(1);
  command->footer(kFooter);
  CLI::App* info = command->add_subcommand("info", "Print what is in a map file, and check it");
  info->add_option("MAP", *path, "Map file, .ofm")->required();
  info->callback([path] { PrintInfo(*path); });
}

}  // namespace ofm
