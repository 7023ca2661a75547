#include "ofm/dense/label_color.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace ofm {
namespace {

TEST(LabelColor, FirstClassesHaveTheColorsOfPascalVoc) {
  EXPECT_EQ(LabelColor(0), (Rgb{128, 0, 0}));       // aeroplane
  EXPECT_EQ(LabelColor(1), (Rgb{0, 128, 0}));       // bicycle
  EXPECT_EQ(LabelColor(14), (Rgb{192, 128, 128}));  // person
  EXPECT_EQ(LabelColor(19), (Rgb{0, 64, 128}));     // tv/monitor
}

TEST(LabelColor, NoTwoClassesShareOne) {
  std::set<std::tuple<int, int, int>> colors;
  for (int id = 0; id < 256; ++id) {
    const Rgb color = LabelColor(static_cast<std::uint8_t>(id));
    colors.insert({color.r, color.g, color.b});
  }
  EXPECT_EQ(colors.size(), 256u);
}

}  // namespace
}  // namespace ofm
