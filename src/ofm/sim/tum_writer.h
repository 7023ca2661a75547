// Writes a simulated sequence as a TUM RGB-D folder.
#pragma once

#include <filesystem>
#include <functional>

#include "ofm/sim/sim_sequence.h"

namespace ofm {

enum class FlowFiles {
  kNone,
  kWrite,  ///< flow/ too: 16-bit PNGs as EncodeFlow makes them, of each frame but the last
};

struct TumWriterOptions {
  FlowFiles flow = FlowFiles::kNone;
  int threads = 1;  ///< that render and write frames; the bytes do not depend on it
  /// Told the share that is done, by the caller's thread, now and then and at the end.
  std::function<void(double share)> on_share;
  /// Given each frame once, by any of the threads and in any order, to write what belongs to it.
  std::function<void(const SimFrame&)> on_frame;
};

/// Writes rgb/ (PNG), depth/ (16-bit PNG, the camera's depth scale), mask/ (8-bit PNG: 0 = static
/// scene, k = the k-th mover; named like the colour file), rgb.txt, depth.txt, associations.txt,
/// groundtruth.txt, camera.json and actors.json (class of each mover) into `folder`, which is made
/// where it is missing. Throws Error with the path where something cannot be written, and passes on
/// what the functions throw.
void WriteTumSequence(const SimSequence& sequence, const std::filesystem::path& folder,
                      const TumWriterOptions& options = {});

}  // namespace ofm
