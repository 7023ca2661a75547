#include "ofm/report/cloud_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "ofm/dense/ply_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::HasSubstr;

std::string PlyOf(const std::vector<LabelledPoint>& points) {
  std::ostringstream stream;
  WritePly(stream, points, std::vector<std::string>{"person", "cell phone"});
  return stream.str();
}

std::vector<LabelledPoint> Row(int count) {
  std::vector<LabelledPoint> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({{static_cast<float>(i), -1.5F, 2}, {1, 2, 3}, 1, 200});
  }
  return points;
}

TEST(LoadCloud, ReadsWhatARunWrites) {
  const TestFolder folder;
  const LabelledCloud cloud = LoadCloud(folder.Write("map.ply", PlyOf(Row(3))), 100);
  ASSERT_EQ(cloud.points.size(), 3U);
  EXPECT_EQ(cloud.points_in_file, 3U);
  EXPECT_EQ(cloud.points[2].position, Eigen::Vector3f(2, -1.5F, 2));
  EXPECT_EQ(cloud.points[2].color, (Rgb{1, 2, 3}));
  EXPECT_EQ(cloud.points[2].class_id, 1);
  EXPECT_EQ(cloud.points[2].confidence, 200);
  EXPECT_EQ(cloud.class_names.at(1), "cell phone");
  EXPECT_EQ(cloud.class_names.at(kNoLabel), "none");
}

TEST(LoadCloud, TakesAnEvenChoiceOfManyPoints) {
  const TestFolder folder;
  const LabelledCloud cloud = LoadCloud(folder.Write("map.ply", PlyOf(Row(1000))), 10);
  ASSERT_EQ(cloud.points.size(), 10U);
  EXPECT_EQ(cloud.points_in_file, 1000U);
  EXPECT_EQ(cloud.points[9].position.x(), 900);
}

TEST(LoadCloud, ReadsOtherPropertiesInAnyOrder) {
  std::string ply =
      "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty ushort instance\r\n"
      "property double y\r\nproperty float x\r\nproperty float z\r\nproperty uchar label\r\n"
      "end_header\r\n";
  const std::uint16_t instance = 513;
  const double y = 2.5;
  const float x = 1, z = 3;
  ply.append(reinterpret_cast<const char*>(&instance), 2);
  ply.append(reinterpret_cast<const char*>(&y), 8);
  ply.append(reinterpret_cast<const char*>(&x), 4);
  ply.append(reinterpret_cast<const char*>(&z), 4);
  ply.push_back(7);
  const TestFolder folder;
  const LabelledCloud cloud = LoadCloud(folder.Write("map.ply", ply), 10);
  ASSERT_EQ(cloud.points.size(), 1U);
  EXPECT_EQ(cloud.points[0].position, Eigen::Vector3f(1, 2.5F, 3));
  EXPECT_EQ(cloud.points[0].class_id, 7);
  EXPECT_EQ(cloud.points[0].color, (Rgb{128, 128, 128}));
}

TEST(LoadCloud, LeavesOutPointsThatAreNotFinite) {
  std::vector<LabelledPoint> points = Row(2);
  points[0].position.z() = std::numeric_limits<float>::quiet_NaN();
  const TestFolder folder;
  EXPECT_EQ(LoadCloud(folder.Write("map.ply", PlyOf(points)), 10).points.size(), 1U);
}

TEST(LoadCloud, SaysWhatIsWrongAndWhere) {
  const TestFolder folder;
  const auto error = [&](const std::string& text) {
    const auto file = folder.Write("map.ply", text);
    return ErrorOf([&] { LoadCloud(file, 10); });
  };
  EXPECT_THAT(error(""), HasSubstr("map.ply:1: is no PLY file"));
  EXPECT_THAT(error("plyx\n"), HasSubstr("map.ply:1: is no PLY file"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("map.ply:2: "));
  EXPECT_THAT(error("ply\nelement face 3\nelement vertex 1\n"), HasSubstr("map.ply:3: "));
  EXPECT_THAT(error("ply\nelement vertex 1\nproperty list uchar int x\n"),
              HasSubstr("map.ply:3: is no 'property TYPE NAME'"));
  EXPECT_THAT(error("ply\nelement vertex x\n"), HasSubstr("map.ply:2: "));
  EXPECT_THAT(error("ply\nelement vertex 1\n"), HasSubstr("no end_header"));
  EXPECT_THAT(error("ply\nelement vertex 1\nproperty float x\nend_header\n"),
              HasSubstr("no property y"));
  std::string cut = PlyOf(Row(3));
  cut.pop_back();
  EXPECT_THAT(error(cut), HasSubstr("map.ply: is truncated"));
  EXPECT_THAT(ErrorOf([&] { LoadCloud(folder.path() / "none.ply", 1); }), HasSubstr("none.ply"));
}

}  // namespace
}  // namespace ofm
