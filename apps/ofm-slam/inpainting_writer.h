// Writes the frames of a run without the people in them, as a TUM folder of its own.
#pragma once

#include <filesystem>
#include <stop_token>

#include "ofm/dense/dense_options.h"
#include "ofm/geometry/trajectory.h"
#include "ofm/io/tum_sequence.h"
#include "ofm/pipeline/run_observer.h"
#include "ofm/pipeline/run_outcome.h"

namespace ofm {

/// During the run keeps what each frame must not show: FOLDER/mask/NAME.png, 255 = dynamic.
class HiddenPixelRecorder : public RunObserver {
 public:
  /// Throws Error for a folder that cannot be made.
  explicit HiddenPixelRecorder(const std::filesystem::path& folder);

  /// Throws Error where the file cannot be written.
  void OnFrame(const FrameReport& report) override;

 private:
  std::filesystem::path masks_;
};

/// After the run: FOLDER/rgb, depth, associations.txt and camera.yaml with every tracked frame,
/// the recorded pixels filled from the keyframes around it (BackgroundInpainter), on all cores.
/// Shows progress on the terminal. A stop that is requested meanwhile leaves the folder with the
/// frames so far. Throws Error where a file cannot be read or written.
void WriteInpaintedFrames(const std::filesystem::path& folder, const RgbdSequence& sequence,
                          const RunOutcome& outcome, const DenseOptions& options,
                          const std::stop_token& stop);

}  // namespace ofm
