#include "ofm/pipeline/frame_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/table_file.h"

namespace ofm {
namespace {

constexpr std::string_view kColumns =
    "stamp,status,keyframe,masked_share,instances,features,inliers";

constexpr std::array<std::pair<TrackingStatus, std::string_view>, 6> kStatusNames = {{
    {TrackingStatus::kWaiting, "waiting"},
    {TrackingStatus::kInitialized, "initialized"},
    {TrackingStatus::kTracked, "tracked"},
    {TrackingStatus::kRelocalized, "relocalized"},
    {TrackingStatus::kReckoned, "reckoned"},
    {TrackingStatus::kLost, "lost"},
}};

std::string_view NameOf(TrackingStatus status) {
  for (const auto& [value, name] : kStatusNames) {
    if (value == status) return name;
  }
  return "";
}

TrackingStatus ReadStatus(const TableFile& file, const TableFile::Row& row, std::size_t field) {
  for (const auto& [value, name] : kStatusNames) {
    if (row.fields[field] == name) return value;
  }
  file.Fail(row, fmt::format("field {} is no state of tracking", field + 1));
}

std::size_t ReadCount(const TableFile& file, const TableFile::Row& row, std::size_t field) {
  const double value = file.Number(row, field);
  if (value < 0 || value > 1e9 || value != std::floor(value)) {
    file.Fail(row, fmt::format("field {} is no count", field + 1));
  }
  return static_cast<std::size_t>(value);
}

double ReadShare(const TableFile& file, const TableFile::Row& row, std::size_t field) {
  const double value = file.Number(row, field);
  if (value < 0 || value > 1) file.Fail(row, fmt::format("field {} is not in 0 to 1", field + 1));
  return value;
}

/// The first row, which names the columns; the first one is the stamp.
const TableFile::Row& RequireHeader(const TableFile& file) {
  if (file.rows().empty()) throw Error(file.path(), 1, "has no line that names the columns");
  const TableFile::Row& header = file.rows().front();
  if (header.fields[0] != "stamp") file.Fail(header, "does not begin with the column 'stamp'");
  return header;
}

}  // namespace

std::string FormatFrames(std::span<const FrameRecord> frames) {
  std::string text = fmt::format("{}\n", kColumns);
  for (const FrameRecord& frame : frames) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{:.4f},{},{},{}\n",
                   FormatSeconds(frame.stamp_ns), NameOf(frame.status), frame.is_keyframe ? 1 : 0,
                   frame.masked_share, frame.instances, frame.features, frame.inliers);
  }
  return text;
}

std::vector<FrameRecord> LoadFrames(const std::filesystem::path& path) {
  const TableFile file(path);
  RequireHeader(file);
  std::vector<FrameRecord> frames;
  StampOrder order;
  for (std::size_t i = 1; i < file.rows().size(); ++i) {
    const TableFile::Row& row = file.rows()[i];
    file.RequireColumns(row, kColumns);
    FrameRecord frame;
    frame.stamp_ns = file.Stamp(row, 0);
    order.Require(file, row, frame.stamp_ns);
    frame.status = ReadStatus(file, row, 1);
    frame.is_keyframe = ReadCount(file, row, 2) != 0;
    frame.masked_share = ReadShare(file, row, 3);
    frame.instances = ReadCount(file, row, 4);
    frame.features = ReadCount(file, row, 5);
    frame.inliers = ReadCount(file, row, 6);
    frames.push_back(frame);
  }
  return frames;
}

FrameTimes TimesOfFrames(std::span<const FrameRecord> frames, const StageTimes& times) {
  FrameTimes result;
  for (const FrameRecord& frame : frames) result.stamps_ns.push_back(frame.stamp_ns);
  for (const auto& [stage, durations] : times.stages()) {
    if (durations.cpu_ms.size() != frames.size()) continue;
    result.stages.push_back(stage);
    result.cpu_ms.push_back(durations.cpu_ms);
  }
  return result;
}

std::string FormatFrameTimes(const FrameTimes& times) {
  std::string text =
      fmt::format("stamp{}{}\n", times.stages.empty() ? "" : ",", fmt::join(times.stages, ","));
  for (std::size_t frame = 0; frame < times.stamps_ns.size(); ++frame) {
    text += FormatSeconds(times.stamps_ns[frame]);
    for (const std::vector<double>& stage : times.cpu_ms) {
      fmt::format_to(std::back_inserter(text), ",{:.3f}", stage[frame]);
    }
    text += '\n';
  }
  return text;
}

FrameTimes LoadFrameTimes(const std::filesystem::path& path) {
  const TableFile file(path);
  const TableFile::Row& header = RequireHeader(file);
  FrameTimes times;
  times.stages.assign(header.fields.begin() + 1, header.fields.end());
  times.cpu_ms.resize(times.stages.size());
  StampOrder order;
  for (std::size_t i = 1; i < file.rows().size(); ++i) {
    const TableFile::Row& row = file.rows()[i];
    if (row.fields.size() != header.fields.size()) {
      file.Fail(row, fmt::format("has {} fields where the first line has {}", row.fields.size(),
                                 header.fields.size()));
    }
    times.stamps_ns.push_back(file.Stamp(row, 0));
    order.Require(file, row, times.stamps_ns.back());
    for (std::size_t stage = 0; stage < times.stages.size(); ++stage) {
      times.cpu_ms[stage].push_back(file.Number(row, stage + 1));
    }
  }
  return times;
}

}  // namespace ofm
