#include "ofm/sim/tum_writer.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/make_folder.h"
#include "ofm/io/trajectory_file.h"

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

}  // namespace

void WriteTumSequence(const SimSequence& sequence, const fs::path& folder) {
  for (const char* name : {"rgb", "depth", "mask"}) MakeFolder(folder / name);
  WriteFileAtomically(folder / "camera.json", CameraJson(sequence.camera()));
  WriteFileAtomically(folder / "actors.json", ActorsJson(sequence.scene()));
  SaveTrajectory(folder / "groundtruth.txt", sequence.GroundTruth());
  std::string rgb = "# timestamp filename\n", depth = rgb, associations;
  for (std::uint32_t i = 0; i < *sequence.size(); ++i) {
    const RgbdFrame frame = sequence.Frame(FrameId(i));
    const std::string rgb_line = fmt::format("{0} rgb/{0}.png", frame.name);
    const std::string depth_line = fmt::format("{0} depth/{0}.png", frame.name);
    cv::Mat depth_units;
    frame.depth_m.convertTo(depth_units, CV_16UC1, sequence.camera().depth_scale);
    WriteImage(folder / "rgb" / (frame.name + ".png"), frame.color);
    WriteImage(folder / "depth" / (frame.name + ".png"), depth_units);
    WriteImage(folder / "mask" / (frame.name + ".png"), sequence.MoverMask(frame.id));
    rgb += rgb_line + "\n";
    depth += depth_line + "\n";
    associations += rgb_line + " " + depth_line + "\n";
  }
  // The lists come last: a folder without them is not taken for a whole sequence.
  WriteFileAtomically(folder / "rgb.txt", rgb);
  WriteFileAtomically(folder / "depth.txt", depth);
  WriteFileAtomically(folder / "associations.txt", associations);
}

}  // namespace ofm
