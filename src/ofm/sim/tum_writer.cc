#include "ofm/sim/tum_writer.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "ofm/base/error.h"
#include "ofm/base/time.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;

/// A text file that notices when it cannot be written.
class TextFile {
 public:
  explicit TextFile(fs::path path) : path_(std::move(path)), stream_(path_) {
    if (!stream_) throw Error(path_, "cannot be opened for writing");
  }
  void Write(const std::string& text) { stream_ << text; }
  void Close() {
    stream_.close();
    if (!stream_) throw Error(path_, "could not be written to the end");
  }

 private:
  fs::path path_;
  std::ofstream stream_;
};

void WriteText(const fs::path& path, const std::string& text) {
  TextFile file(path);
  file.Write(text);
  file.Close();
}

void MakeFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw Error(path, "cannot make the folder: " + error.message());
}

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
  return json.dump(1) + "\n";
}

std::string ActorsJson(const Scene& scene) {
  nlohmann::ordered_json actors = nlohmann::ordered_json::array();
  for (std::uint32_t id = 1; id <= scene.mover_count(); ++id) {
    actors.push_back({{"id", id}, {"kind", scene.class_names()[id]}});
  }
  return nlohmann::ordered_json{{"actors", actors}}.dump(1) + "\n";
}

std::string PoseLine(const StampedPose& pose) {
  const Eigen::Vector3d& t = pose.world_from_camera.translation();
  const Eigen::Quaterniond& q = pose.world_from_camera.rotation();
  return fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n",
                     FormatSeconds(pose.stamp_ns), t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

}  // namespace

void WriteTumSequence(const SimSequence& sequence, const fs::path& folder) {
  for (const char* name : {"rgb", "depth", "mask"}) MakeFolder(folder / name);
  WriteText(folder / "camera.json", CameraJson(sequence.camera()));
  WriteText(folder / "actors.json", ActorsJson(sequence.scene()));
  TextFile rgb(folder / "rgb.txt"), depth(folder / "depth.txt");
  TextFile associations(folder / "associations.txt"), truth(folder / "groundtruth.txt");
  rgb.Write("# timestamp filename\n");
  depth.Write("# timestamp filename\n");
  truth.Write("# timestamp tx ty tz qx qy qz qw\n");
  for (const StampedPose& pose : sequence.GroundTruth()) truth.Write(PoseLine(pose));
  for (std::uint32_t i = 0; i < *sequence.size(); ++i) {
    const RgbdFrame frame = sequence.Frame(FrameId(i));
    const std::string rgb_line = fmt::format("{0} rgb/{0}.png", frame.name);
    const std::string depth_line = fmt::format("{0} depth/{0}.png", frame.name);
    cv::Mat depth_units;
    frame.depth_m.convertTo(depth_units, CV_16UC1, sequence.camera().depth_scale);
    WriteImage(folder / "rgb" / (frame.name + ".png"), frame.color);
    WriteImage(folder / "depth" / (frame.name + ".png"), depth_units);
    WriteImage(folder / "mask" / (frame.name + ".png"), sequence.MoverMask(frame.id));
    rgb.Write(rgb_line + "\n");
    depth.Write(depth_line + "\n");
    associations.Write(rgb_line + " " + depth_line + "\n");
  }
  for (TextFile* file : {&rgb, &depth, &associations, &truth}) file->Close();
}

}  // namespace ofm
