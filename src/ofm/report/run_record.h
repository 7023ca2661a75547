// A folder that `ofm-slam run` has written, read again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ofm/geometry/trajectory.h"
#include "ofm/objects/scene_object.h"
#include "ofm/pipeline/frame_table.h"
#include "ofm/report/cloud_file.h"
#include "ofm/report/run_summary.h"
#include "ofm/report/voxel_file.h"

namespace ofm {

/// A small picture of a key frame.
struct KeyframePicture {
  std::int64_t stamp_ns = 0;
  std::filesystem::path file;
};

/// What a run left. All but the trajectory may be missing: the run may be of an older program, or
/// made without a map or a segmenter.
struct RunRecord {
  std::filesystem::path folder;
  std::string name;       ///< by which a report tells it from others
  Trajectory trajectory;  ///< world_from_camera; may be empty
  std::optional<Trajectory> live, keyframes;
  std::optional<RunSummary> summary;
  std::optional<std::vector<FrameRecord>> frames;
  std::optional<FrameTimes> times;
  std::optional<LabelledCloud> cloud;
  std::optional<VoxelSet> voxels;
  std::optional<ObjectInventory> objects;
  std::vector<KeyframePicture> pictures;  ///< in order of time
};

/// How much of a map is read; 0 = its file is not looked at.
struct RecordLimits {
  std::size_t points = 0, voxels = 0;
};

/// Throws Error that names what is wrong: no such folder, no trajectory.txt in it, or a file that
/// cannot be read (with its line).
RunRecord LoadRunRecord(const std::filesystem::path& folder, const RecordLimits& limits);

/// The folders' names, with as much of the path before them as tells them apart.
std::vector<std::string> NamesOf(const std::vector<std::filesystem::path>& folders);

}  // namespace ofm
