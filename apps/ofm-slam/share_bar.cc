#include "share_bar.h"

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

ShareBar::ShareBar(std::string step)
    : step_(std::move(step)), terminal_(isatty(STDERR_FILENO) == 1) {}

ShareBar::~ShareBar() {
  if (terminal_ && drawn_ns_ != 0) std::fputc('\n', stderr);
}

void ShareBar::OnShare(double share) {
  if (is_complete_) return;
  is_complete_ = share >= 1;
  const std::int64_t now_ns = SteadyTimeNs();
  const std::int64_t interval_ns = terminal_ ? kTerminalIntervalNs : kLogIntervalNs;
  if (!is_complete_ && drawn_ns_ != 0 && now_ns - drawn_ns_ < interval_ns) return;
  drawn_ns_ = now_ns;
  const std::string line = fmt::format("{}{:3.0f} % {}", DrawShare(share), 100 * share, step_);
  fmt::print(stderr, "{}", terminal_ ? fmt::format("\r{}\x1b[K", line) : line + "\n");
  std::fflush(stderr);
}

}  // namespace ofm
