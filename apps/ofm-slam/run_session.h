// One run of the system on a recorded sequence, with its files.
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>

#include "ofm/io/tum_sequence.h"
#include "ofm/pipeline/options.h"
#include "ofm/pipeline/result_writer.h"
#include "ofm/pipeline/run_outcome.h"
#include "ofm/view/web_server.h"

namespace ofm {

struct RunSettings {
  std::filesystem::path sequence, output;
  std::string camera = "auto";        ///< preset, file or "auto"
  std::filesystem::path true_masks;   ///< instance PNGs to measure culling against; may be empty
  std::filesystem::path debug_video;  ///< .avi or folder; may be empty
  std::filesystem::path write_masks;  ///< folder; may be empty
  std::filesystem::path write_inpainted;  ///< folder; may be empty
  std::filesystem::path load_map;         ///< to go on with, or to localise in; may be empty
  std::filesystem::path save_map;         ///< to be written at the end; may be empty
  FrameRange range;
  bool threaded = false;
  bool realtime = false;           ///< at the recorded pace; frames that come too early wait
  std::size_t realtime_queue = 8;  ///< frames that can wait; of more the oldest are dropped
  bool quiet = false;              ///< no progress bar
  bool view = false;               ///< serve a page that shows the run while it goes on
  WebServerOptions view_server = {"127.0.0.1", 8642};
  SlamOptions options;
};

struct RunReport {
  RunOutcome outcome;
  RunDescription description;
  double map_saving_s = 0;
};

/// Opens the sequence, runs the system and writes all results. Bad input is reported before
/// anything is written, and so is a first frame that cannot be read; where a later one fails, the
/// results up to it are written and outcome.error tells why.
RunReport RunSession(const RunSettings& settings, std::stop_token stop = {});

/// A summary for people, with units; ends in a newline.
std::string FormatSummary(const RunReport& report);

}  // namespace ofm
