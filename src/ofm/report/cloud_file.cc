#include "ofm/report/cloud_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include "ofm/base/error.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct ScalarName {
  std::string_view name;
  Scalar type;
  std::size_t bytes;
};

constexpr std::array<ScalarName, 16> kScalarNames = {{
    {"char", Scalar::kInt8, 1},
    {"int8", Scalar::kInt8, 1},
    {"uchar", Scalar::kUint8, 1},
    {"uint8", Scalar::kUint8, 1},
    {"short", Scalar::kInt16, 2},
    {"int16", Scalar::kInt16, 2},
    {"ushort", Scalar::kUint16, 2},
    {"uint16", Scalar::kUint16, 2},
    {"int", Scalar::kInt32, 4},
    {"int32", Scalar::kInt32, 4},
    {"uint", Scalar::kUint32, 4},
    {"uint32", Scalar::kUint32, 4},
    {"float", Scalar::kFloat, 4},
    {"float32", Scalar::kFloat, 4},
    {"double", Scalar::kDouble, 8},
    {"float64", Scalar::kDouble, 8},
}};

template <class T>
double ReadAs(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));  // the hosts we build for are little-endian
  return static_cast<double>(value);
}

double ReadScalar(Scalar type, const char* bytes) {
  switch (type) {
    case Scalar::kInt8:
      return ReadAs<std::int8_t>(bytes);
    case Scalar::kUint8:
      return ReadAs<std::uint8_t>(bytes);
    case Scalar::kInt16:
      return ReadAs<std::int16_t>(bytes);
    case Scalar::kUint16:
      return ReadAs<std::uint16_t>(bytes);
    case Scalar::kInt32:
      return ReadAs<std::int32_t>(bytes);
    case Scalar::kUint32:
      return ReadAs<std::uint32_t>(bytes);
    case Scalar::kFloat:
      return ReadAs<float>(bytes);
    case Scalar::kDouble:
      return ReadAs<double>(bytes);
  }
  return 0;
}

/// Where a property is within a vertex.
struct Property {
  std::string name;
  Scalar type = Scalar::kFloat;
  std::size_t offset = 0;
};

struct Header {
  std::vector<Property> properties;  // of the vertices
  std::size_t vertices = 0, stride = 0, data_begin = 0;
  std::map<int, std::string> class_names;

  const Property* Find(std::string_view name) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& p) { return p.name == name; });
    return found == properties.end() ? nullptr : &*found;
  }
};

/// Reads a header line by line.
class HeaderReader {
 public:
  HeaderReader(const std::filesystem::path& path, const std::string& bytes)
      : path_(path), bytes_(bytes) {}

  Header Read() {
    if (NextLine() != "ply") Fail("is no PLY file");
    for (;;) {
      std::istringstream fields(NextLine());
      std::string key;
      fields >> key;
      if (key == "end_header") break;
      if (key == "format") ReadFormat(fields);
      if (key == "comment") ReadComment(fields);
      if (key == "element") ReadElement(fields);
      if (key == "property" && in_vertex_) ReadProperty(fields);
    }
    for (const char* axis : {"x", "y", "z"}) {
      if (header_.Find(axis) == nullptr) Fail(fmt::format("has no property {} of vertices", axis));
    }
    header_.data_begin = next_;
    return header_;
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const { throw Error(path_, line_, message); }

  std::string NextLine() {
    ++line_;
    const std::size_t end = bytes_.find('\n', next_);
    if (end == std::string::npos) Fail(line_ == 1 ? "is no PLY file" : "has no end_header");
    std::string line = bytes_.substr(next_, end - next_);
    if (line.ends_with('\r')) line.pop_back();
    next_ = end + 1;
    return line;
  }

  void ReadFormat(std::istringstream& fields) {
    std::string format;
    fields >> format;
    if (format == "binary_little_endian") return;
    Fail(fmt::format("is a PLY file of format '{}', not binary_little_endian as run writes it",
                     format));
  }

  void ReadComment(std::istringstream& fields) {
    std::string key, name;
    int id = 0;
    fields >> key >> id;
    if (key != "label" || !fields) return;
    std::getline(fields >> std::ws, name);
    header_.class_names[id] = name;
  }

  void ReadElement(std::istringstream& fields) {
    std::string name;
    std::size_t count = 0;
    fields >> name >> count;
    if (!fields) Fail("is no 'element NAME COUNT'");
    const bool is_first = !seen_element_;
    seen_element_ = true;
    in_vertex_ = name == "vertex";
    if (in_vertex_ && !is_first) Fail("has another element before the vertices");
    if (in_vertex_) header_.vertices = count;
  }

  void ReadProperty(std::istringstream& fields) {
    std::string type, name;
    fields >> type >> name;
    const auto* scalar = std::find_if(kScalarNames.begin(), kScalarNames.end(),
                                      [&](const ScalarName& s) { return s.name == type; });
    if (!fields || scalar == kScalarNames.end()) {
      Fail("is no 'property TYPE NAME' of a scalar type");
    }
    header_.properties.push_back({name, scalar->type, header_.stride});
    header_.stride += scalar->bytes;
  }

  const std::filesystem::path& path_;
  const std::string& bytes_;
  Header header_;
  std::size_t next_ = 0;
  int line_ = 0;
  bool in_vertex_ = false, seen_element_ = false;
};

/// A property of one vertex, or `fallback` where vertices have none of that name.
class VertexReader {
 public:
  VertexReader(const Header& header, const char* name, double fallback)
      : property_(header.Find(name)), fallback_(fallback) {}

  double operator()(const char* vertex) const {
    return property_ == nullptr ? fallback_
                                : ReadScalar(property_->type, vertex + property_->offset);
  }
  std::uint8_t Byte(const char* vertex) const {
    const double value = (*this)(vertex);
    return static_cast<std::uint8_t>(std::isfinite(value) ? std::clamp(value, 0., 255.) : 0);
  }

 private:
  const Property* property_;
  double fallback_;
};

}  // namespace

LabelledCloud LoadCloud(const std::filesystem::path& path, std::size_t max_points) {
  const std::string bytes = ReadFile(path);
  const Header header = HeaderReader(path, bytes).Read();
  if ((bytes.size() - header.data_begin) / header.stride < header.vertices) {
    throw Error(path, "is truncated");
  }
  const VertexReader x(header, "x", 0), y(header, "y", 0), z(header, "z", 0);
  const VertexReader red(header, "red", 128), green(header, "green", 128),
      blue(header, "blue", 128);
  const VertexReader label(header, "label", kNoLabel), confidence(header, "confidence", 255);
  LabelledCloud cloud;
  cloud.points_in_file = header.vertices;
  cloud.class_names = header.class_names;
  const std::size_t count = std::min(max_points, header.vertices);
  cloud.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = i * header.vertices / count;
    const char* vertex = bytes.data() + header.data_begin + index * header.stride;
    const Eigen::Vector3f position = Eigen::Vector3d(x(vertex), y(vertex), z(vertex)).cast<float>();
    if (!position.allFinite()) continue;
    cloud.points.push_back({position,
                            {red.Byte(vertex), green.Byte(vertex), blue.Byte(vertex)},
                            label.Byte(vertex),
                            confidence.Byte(vertex)});
  }
  return cloud;
}

}  // namespace ofm
