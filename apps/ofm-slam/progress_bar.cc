#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "ofm/base/timing.h"

namespace ofm {
namespace {

constexpr std::int64_t kTerminalIntervalNs = 100'000'000;
constexpr std::int64_t kLogIntervalNs = 5'000'000'000;

const char* StatusName(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kWaiting:
      return "waiting";
    case TrackingStatus::kInitialized:
    case TrackingStatus::kTracked:
      return "tracking";
    case TrackingStatus::kRelocalized:
      return "relocalised";
    case TrackingStatus::kReckoned:
      return "reckoning";
    case TrackingStatus::kLost:
      return "LOST";
  }
  return "?";
}

}  // namespace

std::string DrawShare(double share) {
  constexpr int kWidth = 20;
  const int filled = std::clamp(static_cast<int>(share * kWidth), 0, kWidth);
  return fmt::format("[{:#<{}}{:.<{}}] ", "", filled, "", kWidth - filled);
}

ProgressBar::ProgressBar(std::optional<std::size_t> total)
    : total_(total), terminal_(isatty(STDERR_FILENO) == 1), start_ns_(SteadyTimeNs()) {}

ProgressBar::~ProgressBar() {
  if (terminal_ && drawn_ns_ != 0) std::fputc('\n', stderr);
}

void ProgressBar::OnFrame(const FrameReport& report) {
  const std::int64_t now_ns = SteadyTimeNs();
  const bool last = total_ && report.frames_done == *total_;
  const std::int64_t interval_ns = terminal_ ? kTerminalIntervalNs : kLogIntervalNs;
  if (!last && drawn_ns_ != 0 && now_ns - drawn_ns_ < interval_ns) return;
  drawn_ns_ = now_ns;
  const std::string line = Line(report, static_cast<double>(now_ns - start_ns_) * 1e-9);
  const std::string shown = terminal_ ? fmt::format("\r{}\x1b[K", line) : fmt::format("{}\n", line);
  std::fputs(shown.c_str(), stderr);
  std::fflush(stderr);
}

std::string ProgressBar::Line(const FrameReport& report, double elapsed_s) const {
  std::string line;
  if (total_ && *total_ > 0) {
    line = DrawShare(static_cast<double>(report.frames_done) / static_cast<double>(*total_));
  }
  line += fmt::format("{}{} frames", report.frames_done, total_ ? fmt::format("/{}", *total_) : "");
  const double rate = elapsed_s > 0 ? static_cast<double>(report.frames_done) / elapsed_s : 0;
  line += fmt::format(", {:.1f} fps, {}, {} keyframes, {} landmarks, {:.0f} % masked", rate,
                      StatusName(report.tracking.status), report.keyframes, report.landmarks,
                      100 * report.prepared.dynamic.masked_share);
  return line;
}

}  // namespace ofm
