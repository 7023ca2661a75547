// Writes a simulated sequence as a TUM RGB-D folder.
#pragma once

#include <filesystem>

#include "ofm/sim/sim_sequence.h"

namespace ofm {

/// Writes rgb/ (PNG), depth/ (16-bit PNG, the camera's depth scale), mask/ (8-bit PNG: 0 = static
/// scene, k = the k-th mover; named like the colour file), rgb.txt, depth.txt, associations.txt,
/// groundtruth.txt, camera.json and actors.json (class of each mover) into `folder`, which is made
/// where it is missing. Throws Error with the path where something cannot be written.
void WriteTumSequence(const SimSequence& sequence, const std::filesystem::path& folder);

}  // namespace ofm
