#include "ofm/dense/ply_file.h"

#include <bit>
#include <cstring>

#include "ofm/base/error.h"

namespace ofm {
namespace {

void AppendFloat(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<char>(bits >> shift & 0xFF));
  }
}

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
         << "comment label 255 none\n";
  for (std::size_t id = 0; id < class_names.size(); ++id) {
    stream << "comment label " << id << ' ' << OneLine(class_names[id]) << '\n';
  }
  stream << "element vertex " << points << '\n';
  for (const char* axis : {"x", "y", "z"}) stream << "property float " << axis << '\n';
  for (const char* field : {"red", "green", "blue", "label", "confidence"}) {
    stream << "property uchar " << field << '\n';
  }
  stream << "end_header\n";
}

}  // namespace

void WritePly(std::ostream& stream, std::span<const LabelledPoint> cloud,
              std::span<const std::string> class_names) {
  WriteHeader(stream, cloud.size(), class_names);
  std::string bytes;
  bytes.reserve(17 * cloud.size());
  for (const LabelledPoint& point : cloud) {
    for (int axis = 0; axis < 3; ++axis) AppendFloat(bytes, point.position[axis]);
    for (const std::uint8_t byte :
         {point.color.r, point.color.g, point.color.b, point.class_id, point.confidence}) {
      bytes.push_back(static_cast<char>(byte));
    }
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw Error("the point cloud could not be written; is the disk full?");
}

}  // namespace ofm
