#include "ofm/dense/pcd_file.h"

#include "ofm/base/error.h"
#include "ofm/dense/append_bytes.h"
#include "ofm/dense/label_color.h"

namespace ofm {

void WritePcd(std::ostream& stream, std::span<const LabelledPoint> cloud, MapColor color) {
  stream << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
         << "FIELDS x y z rgb label instance confidence\nSIZE 4 4 4 4 4 2 1\n"
         << "TYPE F F F U U U U\nCOUNT 1 1 1 1 1 1 1\n"
         << "WIDTH " << cloud.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
         << "POINTS " << cloud.size() << "\nDATA binary\n";
  constexpr std::size_t kPointBytes = 23;
  std::string bytes;
  bytes.reserve(kPointBytes * cloud.size());
  for (const LabelledPoint& point : cloud) {
    for (const float coordinate : point.position) AppendBytes(bytes, coordinate);
    const Rgb rgb = ChooseColor(color, point.color, point.class_id);
    AppendBytes(bytes, static_cast<std::uint32_t>(rgb.r << 16 | rgb.g << 8 | rgb.b));
    AppendBytes(bytes, static_cast<std::uint32_t>(point.class_id));
    AppendBytes(bytes, point.instance);
    AppendBytes(bytes, point.confidence);
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw Error("the point cloud could not be written; is the disk full?");
}

}  // namespace ofm
