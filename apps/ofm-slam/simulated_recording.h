// Recordings of made worlds, as files.
#pragma once

#include <filesystem>

#include "ofm/sim/sim_sequence.h"
#include "ofm/sim/tum_writer.h"

namespace ofm {

/// Of a camera that a hand holds, with a Kinect's flaws where noise.model is kKinect.
SimSequenceOptions HandHeldOptions();

struct RecordingOptions {
  FlowFiles flow = FlowFiles::kNone;
  int threads = 0;  ///< 0: one for each core
  bool quiet = false;
};

/// Writes a TUM RGB-D folder with masks as PNG, and as the instances that a perfect network would
/// find; with a progress bar. Throws Error where a file cannot be written.
void WriteRecording(const SimSequence& sequence, const std::filesystem::path& folder,
                    const RecordingOptions& options);

}  // namespace ofm
