// Shows a download's progress on the terminal.
#pragma once

#include <cstdint>

namespace ofm {

/// One line on stderr: share, bytes, rate. On a terminal it is drawn anew a few times a second;
/// elsewhere a line is printed now and then.
class DownloadBar {
 public:
  DownloadBar();
  ~DownloadBar();
  DownloadBar(const DownloadBar&) = delete;
  DownloadBar& operator=(const DownloadBar&) = delete;

  /// `total` is 0 where it is not known.
  void OnBytes(std::uint64_t done, std::uint64_t total);

 private:
  bool terminal_;
  std::int64_t start_ns_, drawn_ns_ = 0;
  std::uint64_t drawn_bytes_ = 0;
};

}  // namespace ofm
