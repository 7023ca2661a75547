#include "ofm/pipeline/delay_meter.h"

#include <utility>

namespace ofm {

DelayMeter::DelayMeter(const PacedSource& source, PacingClock clock)
    : source_(source), clock_(std::move(clock)) {}

void DelayMeter::OnFrame(const FrameReport& report) {
  const std::int64_t due_ns = source_.DueNs(report.prepared.frame.stamp_ns);
  delays_ms_.push_back(static_cast<double>(clock_.now_ns() - due_ns) * 1e-6);
}

}  // namespace ofm
