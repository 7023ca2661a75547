// What happened at each frame of a run, and how long it took, as tables.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "ofm/base/timing.h"
#include "ofm/pipeline/frame_record.h"

namespace ofm {

/// frames.csv: a header line, then "stamp,status,keyframe,masked_share,instances,features,inliers"
/// of each frame [s, -, 0 or 1, 0 to 1, counts]. About 60 bytes a frame.
std::string FormatFrames(std::span<const FrameRecord> frames);

/// Throws Error with file and line for a file that FormatFrames did not write.
std::vector<FrameRecord> LoadFrames(const std::filesystem::path& path);

/// CPU time of the stages that ran exactly once for each frame.
struct FrameTimes {
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string> stages;
  std::vector<std::vector<double>> cpu_ms;  ///< by stage, then by frame
};

/// Stages that ran more or less often than once a frame are left out: nothing tells which frame
/// their times are of.
FrameTimes TimesOfFrames(std::span<const FrameRecord> frames, const StageTimes& times);

/// times.csv: a header line "stamp" and the stages, then the stamp [s] and the CPU times [ms] of
/// each frame. About 50 bytes a frame.
std::string FormatFrameTimes(const FrameTimes& times);

/// Throws Error with file and line for a file that FormatFrameTimes did not write.
FrameTimes LoadFrameTimes(const std::filesystem::path& path);

}  // namespace ofm
