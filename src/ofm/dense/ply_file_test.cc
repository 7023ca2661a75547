#include "ofm/dense/ply_file.h"

#include <gmock/gmock.h>

#include <cstring>
#include <sstream>

#include "ofm/base/error.h"

namespace ofm {
namespace {

const std::vector<std::string> kNames{"person", "chair\nend_header"};

std::string Write(const std::vector<LabelledPoint>& cloud) {
  std::ostringstream stream;
  WritePly(stream, cloud, kNames);
  return stream.str();
}

TEST(WritePly, TheHeaderNamesFieldsAndClasses) {
  EXPECT_EQ(Write({}),
            "ply\nformat binary_little_endian 1.0\n"
            "comment map by ofm-slam; world frame, metres\n"
            "comment label 255 none\ncomment label 0 person\ncomment label 1 chair end_header\n"
            "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property uchar label\nproperty uchar confidence\nend_header\n");
}

TEST(WritePly, PointsReadBackByteForByte) {
  const std::vector<LabelledPoint> cloud{{{1.5f, -2.25f, 1e-3f}, {1, 2, 253}, 56, 200},
                                         {{-7, 8, 9}, {255, 0, 128}, kNoLabel, 0}};
  const std::string file = Write(cloud);
  const std::string end = "end_header\n";
  const std::size_t start = file.rfind(end) + end.size();
  ASSERT_EQ(file.size() - start, 2u * 17);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const char* record = file.data() + start + 17 * i;
    Eigen::Vector3f position;
    std::memcpy(position.data(), record, 12);
    EXPECT_EQ(position, cloud[i].position);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(record + 12);
    EXPECT_EQ((Rgb{bytes[0], bytes[1], bytes[2]}), cloud[i].color);
    EXPECT_EQ(bytes[3], cloud[i].class_id);
    EXPECT_EQ(bytes[4], cloud[i].confidence);
  }
}

TEST(WritePly, AStreamThatFailsIsAnError) {
  std::ostream full(nullptr);
  EXPECT_THROW(WritePly(full, {}, kNames), Error);
}

}  // namespace
}  // namespace ofm
