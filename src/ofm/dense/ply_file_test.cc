#include "ofm/dense/ply_file.h"

#include <gmock/gmock.h>

#include <cstring>
#include <sstream>

#include "ofm/base/error.h"
#include "ofm/dense/label_color.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

const std::vector<std::string> kNames{"person", "chair\nend_header"};

std::string Write(const std::vector<LabelledPoint>& cloud) {
  std::ostringstream stream;
  WritePly(stream, cloud, kNames);
  return stream.str();
}

TEST(WritePly, TheHeaderNamesFieldsAndClasses) {
  EXPECT_EQ(
      Write({}),
      "ply\nformat binary_little_endian 1.0\n"
      "comment map by ofm-slam; world frame, metres\n"
      "comment label 255 none\ncomment instance is an id of objects.db; 65535 none\n"
      "comment label 0 person\ncomment label 1 chair end_header\n"
      "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property uchar label\nproperty uchar confidence\nproperty ushort instance\nend_header\n");
}

TEST(WritePly, PointsReadBackByteForByte) {
  const std::vector<LabelledPoint> cloud{{{1.5f, -2.25f, 1e-3f}, {1, 2, 253}, 56, 200, 300},
                                         {{-7, 8, 9}, {255, 0, 128}, kNoLabel, 0}};
  const std::string file = Write(cloud);
  const std::string end = "end_header\n";
  const std::size_t start = file.rfind(end) + end.size();
  ASSERT_EQ(file.size() - start, 2u * 19);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const char* record = file.data() + start + 19 * i;
    Eigen::Vector3f position;
    std::memcpy(position.data(), record, 12);
    EXPECT_EQ(position, cloud[i].position);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(record + 12);
    EXPECT_EQ((Rgb{bytes[0], bytes[1], bytes[2]}), cloud[i].color);
    EXPECT_EQ(bytes[3], cloud[i].class_id);
    EXPECT_EQ(bytes[4], cloud[i].confidence);
    EXPECT_EQ(bytes[5] | bytes[6] << 8, cloud[i].instance);
  }
}

TEST(WritePly, ColorsCanShowLabels) {
  std::ostringstream stream;
  const std::vector<LabelledPoint> cloud{{{0, 0, 0}, {1, 2, 3}, 56, 200}};
  WritePly(stream, cloud, {}, MapColor::kLabel);
  const std::string record = stream.str().substr(stream.str().size() - 7);
  const auto channel = [&](std::size_t i) { return static_cast<std::uint8_t>(record[i]); };
  EXPECT_EQ((Rgb{channel(0), channel(1), channel(2)}), LabelColor(56));
}

TEST(LoadPly, ReadsWhatWasWritten) {
  const TestFolder folder;
  const std::vector<LabelledPoint> cloud{{{1.5f, -2.25f, 1e-3f}, {1, 2, 253}, 56, 200, 300},
                                         {{-7, 8, 9}, {255, 0, 128}, kNoLabel, 0}};
  EXPECT_TRUE(LoadPly(folder.Write("empty.ply", Write({}))).empty());
  const std::vector<LabelledPoint> loaded = LoadPly(folder.Write("map.ply", Write(cloud)));
  ASSERT_EQ(loaded.size(), 2u);
  EXPECT_EQ(loaded[0].position, cloud[0].position);
  EXPECT_EQ(loaded[0].color, cloud[0].color);
  EXPECT_EQ(loaded[0].class_id, 56);
  EXPECT_EQ(loaded[0].confidence, 200);
  EXPECT_EQ(loaded[0].instance, 300);
  EXPECT_EQ(loaded[1].instance, kNoInstance);
}

TEST(LoadPly, WhatIsNoSuchFileIsAnErrorThatNamesIt) {
  const TestFolder folder;
  const std::string whole = Write({{{1, 2, 3}, {}, 4, 5}});
  const auto error = [&](const std::string& contents) {
    const auto path = folder.Write("map.ply", contents);
    const std::string message = ErrorOf([&] { LoadPly(path); });
    EXPECT_THAT(message, testing::StartsWith(path.string() + ": "));
    return message;
  };
  EXPECT_THAT(error(whole.substr(0, whole.size() - 1)), testing::HasSubstr("truncated"));
  EXPECT_THAT(error(whole + whole.substr(whole.size() - 19)), testing::HasSubstr("as many points"));
  for (const std::string& other :
       {std::string(), std::string("ply\nend_header\n"), whole.substr(0, 50), "x" + whole}) {
    EXPECT_THAT(error(other), testing::HasSubstr("is no PLY file"));
  }
  EXPECT_THAT(ErrorOf([] { LoadPly("/no/map.ply"); }), testing::HasSubstr("/no/map.ply: does not"));
}

TEST(WritePly, AStreamThatFailsIsAnError) {
  std::ostream full(nullptr);
  EXPECT_THROW(WritePly(full, {}, kNames), Error);
}

}  // namespace
}  // namespace ofm
