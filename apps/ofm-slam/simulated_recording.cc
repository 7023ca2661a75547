#include "simulated_recording.h"

#include <algorithm>
#include <optional>
#include <thread>

#include "instance_writer.h"
#include "share_bar.h"

namespace ofm {

SimSequenceOptions HandHeldOptions() {
  SimSequenceOptions options;
  options.path.jitter_m = 3e-3;
  options.path.jitter_deg = 0.25;
  options.noise.shadow = 1;
  options.noise.dark_dropout = 0.4;
  return options;
}

void WriteRecording(const SimSequence& sequence, const std::filesystem::path& folder,
                    const RecordingOptions& options) {
  const InstanceWriter instances(sequence.scene(), folder / "mask");
  std::optional<ShareBar> bar;
  if (!options.quiet) bar.emplace("simulating");
  TumWriterOptions writing;
  writing.flow = options.flow;
  writing.threads = options.threads > 0
                        ? options.threads
                        : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  writing.on_frame = [&](const SimFrame& frame) { instances.Write(frame); };
  if (bar) writing.on_share = [&](double share) { bar->OnShare(share); };
  WriteTumSequence(sequence, folder, writing);
}

}  // namespace ofm
