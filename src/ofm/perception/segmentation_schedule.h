// When the network runs.
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "ofm/base/options.h"
#include "ofm/perception/mask_propagation.h"

namespace ofm {

enum class SegmentationMode {
  kWait,    ///< frames wait for the network; runs can be repeated to the bit
  kLatest,  ///< the network has a thread of its own and works on the newest frame there is
};

inline EnumNameList<SegmentationMode> EnumNames(SegmentationMode) {
  static constexpr std::array<std::pair<SegmentationMode, std::string_view>, 2> kNames{{
      {SegmentationMode::kWait, "wait"},
      {SegmentationMode::kLatest, "latest"},
  }};
  return kNames;
}

/// What a network that fails does to the run.
enum class SegmentationFailure {
  kStop,      ///< its error ends the run
  kContinue,  ///< masks are carried on, and dropped when they are too old
};

inline EnumNameList<SegmentationFailure> EnumNames(SegmentationFailure) {
  static constexpr std::array<std::pair<SegmentationFailure, std::string_view>, 2> kNames{{
      {SegmentationFailure::kStop, "stop"},
      {SegmentationFailure::kContinue, "continue"},
  }};
  return kNames;
}

struct SegmentationScheduleOptions {
  SegmentationMode mode = SegmentationMode::kWait;
  int every_nth = 1;  ///< the network runs on each n-th frame; masks are carried to those between
  SegmentationFailure on_failure = SegmentationFailure::kStop;  ///< in mode wait
  double max_age_s = 1;  ///< masks whose frame is older are dropped
  int niceness = 19;     ///< by which the network's thread is less urgent (Linux); 19: SCHED_IDLE
  MaskPropagationOptions propagation = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("mode", self.mode, "frames wait for the network, or take the latest masks along");
    visit("every_nth", self.every_nth, "mode wait: the network runs on each n-th frame",
          Range{1, 1000});
    visit("on_failure", self.on_failure, "mode wait: what an error of the network does");
    visit("max_age_s", self.max_age_s, "masks whose frame is older are dropped [s]", Range{0, 60});
    visit("niceness", self.niceness,
          "mode latest: of the network's thread (Linux); 19 takes only what no thread wants",
          Range{0, 19});
    visit("propagation", self.propagation, "how masks are carried");
  }
};

}  // namespace ofm
