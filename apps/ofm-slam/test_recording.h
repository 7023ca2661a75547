// A small simulated recording as a TUM folder, and what the tests of the commands ask of errors.
// Tests only.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "ofm/io/test_folder.h"
#include "ofm/sim/tum_writer.h"
#include "program.h"

namespace ofm {

/// A sequence folder of a room with one person, small and quick to run.
class TestRecording {
 public:
  explicit TestRecording(int frames, double rate_hz = 15) {
    SimSequenceOptions options;
    options.frames = frames;
    options.rate_hz = rate_hz;
    options.camera = MakeSimCamera(240, 180);
    options.room.people = 1;
    WriteTumSequence(SimSequence(options), folder());
  }

  std::filesystem::path folder() const { return root_.path() / "sequence"; }
  std::filesystem::path output() const { return root_.path() / "out"; }
  std::filesystem::path root() const { return root_.path(); }

  /// Path of the colour image of frame `index`.
  std::filesystem::path ColorImage(int index) const {
    std::vector<std::filesystem::path> images;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / "rgb")) {
      images.push_back(entry.path());
    }
    std::sort(images.begin(), images.end());
    return images.at(index);
  }
  std::filesystem::path DepthImage(int index) const {
    return folder() / "depth" / ColorImage(index).filename();
  }

  /// Writes a file at `name` below the sequence.
  void Write(const std::string& name, std::string_view contents) const {
    root_.Write("sequence/" + name, contents);
  }
  /// Uses rgb.txt and depth.txt: without associations.txt.
  void RemoveAssociations() const { std::filesystem::remove(folder() / "associations.txt"); }

  /// Arguments of a quick run of this recording; `more` come last.
  std::string Arguments(const std::string& more = "") const {
    return "run '" + folder().string() + "' --output '" + output().string() +
           "' --set features.count=400 --set dense.resolution_m=0.1 " + more;
  }
  /// Runs it without a progress bar.
  ProgramResult Run(const std::string& more = "") const {
    return RunProgram(Arguments("--quiet " + more));
  }

 private:
  TestFolder root_;
};

inline std::size_t CountLines(const std::filesystem::path& file) {
  const std::string text = ReadFile(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Poses in a trajectory file: lines that are no comment.
inline std::size_t CountPoses(const std::filesystem::path& file) { return CountLines(file) - 1; }

/// One line that begins as every error does.
MATCHER(IsOneErrorLine, "") {
  return arg.starts_with("ofm-slam: error: ") && arg.find('\n') == arg.size() - 1;
}

}  // namespace ofm
