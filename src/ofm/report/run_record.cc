#include "ofm/report/run_record.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/objects/object_database.h"

namespace ofm {
namespace {

/// What `load` makes of the file; empty where there is none.
template <class Load>
auto LoadIfThere(const std::filesystem::path& file, Load&& load)
    -> std::optional<decltype(load(file))> {
  if (!std::filesystem::exists(file)) return {};
  return load(file);
}

std::vector<KeyframePicture> FindPictures(const std::filesystem::path& folder) {
  std::vector<KeyframePicture> pictures;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() != ".jpg") continue;
    const auto stamp_ns = ParseSeconds(entry.path().stem().string());
    if (stamp_ns) pictures.push_back({*stamp_ns, entry.path()});
  }
  std::sort(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
    return std::tie(a.stamp_ns, a.file) < std::tie(b.stamp_ns, b.file);
  });
  return pictures;
}

/// The last `parts` parts of a path.
std::string EndOf(const std::filesystem::path& path, int parts) {
  std::filesystem::path end, rest = path;
  for (int i = 0; i < parts && rest.has_filename(); ++i, rest = rest.parent_path()) {
    end = end.empty() ? rest.filename() : rest.filename() / end;
  }
  return end.empty() ? path.string() : end.string();
}

}  // namespace

RunRecord LoadRunRecord(const std::filesystem::path& folder, const RecordLimits& limits) {
  if (!std::filesystem::is_directory(folder)) {
    throw Error(folder, "is no folder; name one that ofm-slam run has written (--output)");
  }
  if (!std::filesystem::exists(folder / "trajectory.txt")) {
    throw Error(folder, "has no trajectory.txt; name a folder that ofm-slam run has written");
  }
  RunRecord record;
  record.folder = folder;
  record.name = NamesOf({folder}).front();
  record.trajectory = LoadTrajectory(folder / "trajectory.txt");
  record.live = LoadIfThere(folder / "trajectory_live.txt", LoadTrajectory);
  record.keyframes = LoadIfThere(folder / "keyframes.txt", LoadTrajectory);
  record.summary = LoadIfThere(folder / "summary.json", LoadRunSummary);
  record.frames = LoadIfThere(folder / "frames.csv", LoadFrames);
  record.times = LoadIfThere(folder / "times.csv", LoadFrameTimes);
  record.objects = LoadIfThere(folder / "objects.db", LoadObjects);
  record.pictures = FindPictures(folder / "keyframes");
  if (limits.points > 0) {
    record.cloud = LoadIfThere(folder / "map.ply",
                               [&](const auto& file) { return LoadCloud(file, limits.points); });
  }
  if (limits.voxels > 0) {
    record.voxels = LoadIfThere(folder / "map.ot", [&](const auto& file) {
      return LoadVoxels(file, folder / "map_labels.csv", limits.voxels);
    });
  }
  return record;
}

std::vector<std::string> NamesOf(const std::vector<std::filesystem::path>& folders) {
  std::vector<std::filesystem::path> paths;
  for (const std::filesystem::path& folder : folders) {
    std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
    paths.push_back(path.has_filename() ? path : path.parent_path());  // "out/" is "out"
  }
  std::vector<std::string> names;
  for (int parts = 1; parts <= 8; ++parts) {
    names.clear();
    for (const std::filesystem::path& path : paths) names.push_back(EndOf(path, parts));
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) break;
  }
  return names;
}

}  // namespace ofm
