// Shows a run's progress on the terminal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ofm/pipeline/run_observer.h"

namespace ofm {

/// "[####......] ", `share` of it filled.
std::string DrawShare(double share);

/// One line on stderr: frames, rate, tracking state, keyframes, landmarks, masked share. On a
/// terminal it is drawn anew a few times a second; elsewhere a line is printed now and then.
class ProgressBar : public RunObserver {
 public:
  /// `total` frames, where known.
  explicit ProgressBar(std::optional<std::size_t> total);
  ~ProgressBar() override;

  void OnFrame(const FrameReport& report) override;

 private:
  std::string Line(const FrameReport& report, double elapsed_s) const;

  std::optional<std::size_t> total_;
  bool terminal_;
  std::int64_t start_ns_, drawn_ns_ = 0;
};

}  // namespace ofm
