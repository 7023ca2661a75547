#include "ofm/dense/ply_file.h"

#include <bit>
#include <string_view>

#include "ofm/base/error.h"
#include "ofm/dense/append_bytes.h"
#include "ofm/dense/label_color.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

constexpr std::string_view kFields =
    "property float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "property uchar label\nproperty uchar confidence\nproperty ushort instance\n";
constexpr std::string_view kHeaderEnd = "end_header\n";
constexpr std::size_t kPointBytes = 19;

/// On one line, whatever the network's file says.
std::string OneLine(std::string name) {
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  return name;
}

void WriteHeader(std::ostream& stream, std::size_t points,
                 std::span<const std::string> class_names) {
  stream << "ply\nformat binary_little_endian 1.0\n"
         << "comment map by ofm-slam; world frame, metres\n"
         << "comment label 255 none\n"
         << "comment instance is an id of objects.db; " << kNoInstance << " none\n";
  for (std::size_t id = 0; id < class_names.size(); ++id) {
    stream << "comment label " << id << ' ' << OneLine(class_names[id]) << '\n';
  }
  stream << "element vertex " << points << '\n';
  stream << kFields << kHeaderEnd;
}

/// A point from the bytes of its record.
LabelledPoint ReadPoint(const char* record) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(record[i]); };
  LabelledPoint point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint32_t bits = 0;
    for (std::size_t i = 4; i-- > 0;) bits = bits << 8 | byte(4 * axis + i);
    point.position[static_cast<Eigen::Index>(axis)] = std::bit_cast<float>(bits);
  }
  point.color = {byte(12), byte(13), byte(14)};
  point.class_id = byte(15);
  point.confidence = byte(16);
  point.instance = static_cast<std::uint16_t>(byte(17) | byte(18) << 8);
  return point;
}

}  // namespace

void WritePly(std::ostream& stream, std::span<const LabelledPoint> cloud,
              std::span<const std::string> class_names, MapColor color) {
  WriteHeader(stream, cloud.size(), class_names);
  std::string bytes;
  bytes.reserve(kPointBytes * cloud.size());
  for (const LabelledPoint& point : cloud) {
    for (const float coordinate : point.position) AppendBytes(bytes, coordinate);
    const Rgb rgb = ChooseColor(color, point.color, point.class_id);
    for (const std::uint8_t byte : {rgb.r, rgb.g, rgb.b, point.class_id, point.confidence}) {
      AppendBytes(bytes, byte);
    }
    AppendBytes(bytes, point.instance);
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw Error("the point cloud could not be written; is the disk full?");
}

std::vector<LabelledPoint> LoadPly(const std::filesystem::path& path) {
  const std::string file = ReadFile(path);
  constexpr std::string_view kLastLine = "\nend_header\n";  // a class may be named so
  const std::size_t end = file.find(kLastLine) + 1;
  const std::string_view header = std::string_view(file).substr(0, end);
  const bool is_ours =
      header.starts_with("ply\nformat binary_little_endian") && header.ends_with(kFields);
  if (!is_ours) throw Error(path, "is no PLY file of a labelled cloud by ofm-slam");
  const std::size_t start = end + kHeaderEnd.size();
  constexpr std::string_view kElement = "\nelement vertex ";
  const std::string written = std::to_string((file.size() - start) / kPointBytes);
  const bool whole = (file.size() - start) % kPointBytes == 0 &&
                     header.find(std::string(kElement) + written + "\n") != std::string::npos;
  if (!whole) throw Error(path, "has not as many points as its header says; it may be truncated");
  std::vector<LabelledPoint> points;
  for (std::size_t at = start; at < file.size(); at += kPointBytes) {
    points.push_back(ReadPoint(file.data() + at));
  }
  return points;
}

}  // namespace ofm
