// Writes the instances of every frame, to be read again in place of the network.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ofm/pipeline/run_observer.h"

namespace ofm {

/// Each frame's instances to FOLDER/NAME.json (see ofm/perception/instance_file.h), which
/// `--segmenter masks` reads.
class MaskWriter : public RunObserver {
 public:
  /// Throws Error for a folder that cannot be made.
  MaskWriter(std::filesystem::path folder, std::vector<std::string> class_names);

  /// Throws Error where the file cannot be written.
  void OnFrame(const FrameReport& report) override;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> class_names_;
};

}  // namespace ofm
