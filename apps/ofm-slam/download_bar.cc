#include "download_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "ofm/base/timing.h"
#include "progress_bar.h"

namespace ofm {
namespace {

constexpr std::int64_t kTerminalIntervalNs = 100'000'000;
constexpr std::int64_t kLogIntervalNs = 5'000'000'000;

}  // namespace

DownloadBar::DownloadBar() : terminal_(isatty(STDERR_FILENO) == 1), start_ns_(SteadyTimeNs()) {}

DownloadBar::~DownloadBar() {
  if (terminal_ && drawn_ns_ != 0) std::fputc('\n', stderr);
}

void DownloadBar::OnBytes(std::uint64_t done, std::uint64_t total) {
  const std::int64_t now_ns = SteadyTimeNs();
  const bool last = done == total && drawn_bytes_ != done;
  const std::int64_t interval_ns = terminal_ ? kTerminalIntervalNs : kLogIntervalNs;
  if (!last && drawn_ns_ != 0 && now_ns - drawn_ns_ < interval_ns) return;
  drawn_ns_ = now_ns;
  drawn_bytes_ = done;
  constexpr double kMega = 1e6;
  const double elapsed_s = static_cast<double>(now_ns - start_ns_) * 1e-9;
  const double done_mb = static_cast<double>(done) / kMega;
  std::string line =
      total > 0 ? DrawShare(static_cast<double>(done) / static_cast<double>(total)) : std::string();
  line += fmt::format("{:.1f}", done_mb);
  if (total > 0) line += fmt::format(" of {:.1f}", static_cast<double>(total) / kMega);
  line += fmt::format(" MB, {:.1f} MB/s", elapsed_s > 0 ? done_mb / elapsed_s : 0);
  fmt::print(stderr, "{}", terminal_ ? fmt::format("\r{}\x1b[K", line) : line + "\n");
  std::fflush(stderr);
}

}  // namespace ofm
