#include "ofm/dense/pcd_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "ofm/base/error.h"
#include "ofm/dense/label_color.h"

namespace ofm {
namespace {

const std::vector<LabelledPoint> kCloud{{{1.5f, -2.25f, 1e-3f}, {1, 2, 253}, 56, 200, 300},
                                        {{-7, 8, 9}, {255, 0, 128}, kNoLabel, 0}};

std::string Write(const std::vector<LabelledPoint>& cloud, MapColor color = MapColor::kAppearance) {
  std::ostringstream stream;
  WritePcd(stream, cloud, color);
  return stream.str();
}

template <class T>
T ReadAt(const std::string& file, std::size_t offset) {
  T value;
  std::memcpy(&value, file.data() + offset, sizeof(T));
  return value;
}

TEST(WritePcd, TheHeaderNamesFieldsAndPoints) {
  EXPECT_EQ(Write({}),
            "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
            "FIELDS x y z rgb label instance confidence\nSIZE 4 4 4 4 4 2 1\n"
            "TYPE F F F U U U U\nCOUNT 1 1 1 1 1 1 1\nWIDTH 0\nHEIGHT 1\n"
            "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 0\nDATA binary\n");
}

TEST(WritePcd, PointsReadBackByteForByte) {
  const std::string file = Write(kCloud);
  const std::string end = "DATA binary\n";
  const std::size_t start = file.find(end) + end.size();
  ASSERT_EQ(file.size() - start, 2u * 23);
  for (std::size_t i = 0; i < kCloud.size(); ++i) {
    const std::size_t at = start + 23 * i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(ReadAt<float>(file, at + 4 * axis),
                kCloud[i].position[static_cast<Eigen::Index>(axis)]);
    }
    const Rgb& color = kCloud[i].color;
    EXPECT_EQ(ReadAt<std::uint32_t>(file, at + 12), color.r * 65536u + color.g * 256u + color.b);
    EXPECT_EQ(ReadAt<std::uint32_t>(file, at + 16), kCloud[i].class_id);
    EXPECT_EQ(ReadAt<std::uint16_t>(file, at + 20), kCloud[i].instance);
    EXPECT_EQ(ReadAt<std::uint8_t>(file, at + 22), kCloud[i].confidence);
  }
}

TEST(WritePcd, ColorsCanShowLabels) {
  const std::string file = Write(kCloud, MapColor::kLabel);
  const std::size_t start = file.size() - 2 * 23;
  const Rgb chair = LabelColor(56);
  EXPECT_EQ(ReadAt<std::uint32_t>(file, start + 12), chair.r * 65536u + chair.g * 256u + chair.b);
}

TEST(WritePcd, AStreamThatFailsIsAnError) {
  std::ostream full(nullptr);
  EXPECT_THROW(WritePcd(full, {}), Error);
}

}  // namespace
}  // namespace ofm
