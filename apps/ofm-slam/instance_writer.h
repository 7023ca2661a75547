// Writes the true instances of simulated frames as a perfect network would find them.
#pragma once

#include <filesystem>
#include <vector>

#include "ofm/sim/sim_sequence.h"

namespace ofm {

/// Each frame's instances that have a class of COCO to FOLDER/NAME.json, which `--segmenter masks`
/// reads (see ofm/perception/instance_file.h).
class InstanceWriter {
 public:
  InstanceWriter(const Scene& scene, std::filesystem::path folder);

  /// Leaves out what shows fewer pixels than a network could find. The folder must exist. Throws
  /// Error where the file cannot be written. Threads may share it.
  void Write(const SimFrame& frame) const;

 private:
  std::filesystem::path folder_;
  std::vector<ClassId> class_ids_;  ///< by InstanceId; invalid without a class of COCO
};

}  // namespace ofm
