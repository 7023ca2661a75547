#include "ofm/sim/tum_writer.h"

#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>
#include <vector>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/make_folder.h"
#include "ofm/io/trajectory_file.h"
#include "ofm/sim/scene_flow.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;

void WriteImage(const fs::path& path, const cv::Mat& image) {
  // The lowest compression: the files live as long as a test or a demo.
  bool written = false;
  try {
    written = cv::imwrite(path.string(), image, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const cv::Exception& exception) {
    throw Error(path, exception.what());
  }
  if (!written) throw Error(path, "the image cannot be written");
}

std::string CameraJson(const PinholeCamera& camera) {
  nlohmann::ordered_json json;
  json["width"] = camera.width;
  json["height"] = camera.height;
  json["fx"] = camera.fx;
  json["fy"] = camera.fy;
  json["cx"] = camera.cx;
  json["cy"] = camera.cy;
  json["distortion"] = {camera.k1, camera.k2, camera.p1, camera.p2, camera.k3};
  json["depth_scale"] = camera.depth_scale;
  json["baseline_m"] = camera.baseline_m;
  return json.dump(1) + "\n";
}

std::string ActorsJson(const Scene& scene) {
  nlohmann::ordered_json actors = nlohmann::ordered_json::array();
  for (std::uint32_t id = 1; id <= scene.mover_count(); ++id) {
    actors.push_back({{"id", id}, {"kind", scene.class_names()[id]}});
  }
  return nlohmann::ordered_json{{"actors", actors}}.dump(1) + "\n";
}

/// Runs `work` for each of 0 .. count - 1 in `threads` threads, of which this one calls `on_share`.
/// After a failure no further work begins; the first one (by number) is thrown.
void ForEach(std::uint32_t count, int threads, const std::function<void(std::uint32_t)>& work,
             const std::function<void(double)>& on_share) {
  std::atomic<std::uint32_t> next = 0;
  std::vector<std::exception_ptr> failures(count);
  const auto take = [&](const std::function<void(double)>& report) {
    for (std::uint32_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        failures[i] = std::current_exception();
        next = count;
        return;
      }
      if (report) report((i + 1.0) / count);
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads; ++k) others.emplace_back([&take] { take({}); });
    take(on_share);
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  if (on_share) on_share(1);
}

/// Writes the files of single frames.
class FrameWriter {
 public:
  FrameWriter(const SimSequence& sequence, const fs::path& folder, const TumWriterOptions& options)
      : sequence_(sequence), folder_(folder), options_(options) {
    for (const char* name : {"rgb", "depth", "mask"}) MakeFolder(folder / name);
    if (options.flow == FlowFiles::kWrite) MakeFolder(folder / "flow");
  }

  void Write(FrameId id) const {
    const SimFrame rendered = sequence_.Render(id);
    const RgbdFrame& frame = rendered.frame;
    const std::string name = frame.name + ".png";
    cv::Mat depth_units, movers = rendered.instance.clone();
    frame.depth_m.convertTo(depth_units, CV_16UC1, sequence_.camera().depth_scale);
    movers.setTo(0, movers > sequence_.scene().mover_count());
    WriteImage(folder_ / "rgb" / name, frame.color);
    WriteImage(folder_ / "depth" / name, depth_units);
    WriteImage(folder_ / "mask" / name, movers);
    if (options_.flow == FlowFiles::kWrite && id.value + 1 < *sequence_.size()) {
      WriteImage(folder_ / "flow" / name, EncodeFlow(sequence_.FlowToNext(id)));
    }
    if (options_.on_frame) options_.on_frame(rendered);
  }

 private:
  const SimSequence& sequence_;
  fs::path folder_;
  const TumWriterOptions& options_;
};

/// The lists come last: a folder without them is not taken for a whole sequence.
void WriteLists(const SimSequence& sequence, const fs::path& folder) {
  std::string rgb = "# timestamp filename\n", depth = rgb, associations;
  for (std::uint32_t i = 0; i < *sequence.size(); ++i) {
    const std::string name = FormatSeconds(sequence.StampNs(FrameId(i)));
    const std::string rgb_line = fmt::format("{0} rgb/{0}.png", name);
    const std::string depth_line = fmt::format("{0} depth/{0}.png", name);
    rgb += rgb_line + "\n";
    depth += depth_line + "\n";
    associations += rgb_line + " " + depth_line + "\n";
  }
  WriteFileAtomically(folder / "rgb.txt", rgb);
  WriteFileAtomically(folder / "depth.txt", depth);
  WriteFileAtomically(folder / "associations.txt", associations);
}

}  // namespace

void WriteTumSequence(const SimSequence& sequence, const fs::path& folder,
                      const TumWriterOptions& options) {
  const FrameWriter writer(sequence, folder, options);
  WriteFileAtomically(folder / "camera.json", CameraJson(sequence.camera()));
  WriteFileAtomically(folder / "actors.json", ActorsJson(sequence.scene()));
  SaveTrajectory(folder / "groundtruth.txt", sequence.GroundTruth());
  const std::uint32_t count = static_cast<std::uint32_t>(*sequence.size());
  ForEach(
      count, options.threads, [&writer](std::uint32_t i) { writer.Write(FrameId(i)); },
      options.on_share);
  WriteLists(sequence, folder);
}

}  // namespace ofm
