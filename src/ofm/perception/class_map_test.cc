#include "ofm/perception/class_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ofm/perception/class_names.h"

namespace ofm {
namespace {

std::string NameOf(const ClassMap& map, int label) {
  const ClassId id = FindClassOfLabel(map, label);
  return id.valid() ? CocoClassNames().at(id.value) : "none";
}

TEST(ClassMap, Coco91GivesTheNamesOfTheAnnotationFiles) {
  const ClassMap map = MakeCoco91ClassMap();
  for (const auto& [label, name] : std::vector<std::pair<int, std::string>>{{1, "person"},
                                                                            {2, "bicycle"},
                                                                            {11, "fire hydrant"},
                                                                            {13, "stop sign"},
                                                                            {18, "dog"},
                                                                            {25, "giraffe"},
                                                                            {27, "backpack"},
                                                                            {28, "umbrella"},
                                                                            {31, "handbag"},
                                                                            {44, "bottle"},
                                                                            {46, "wine glass"},
                                                                            {62, "chair"},
                                                                            {65, "bed"},
                                                                            {67, "dining table"},
                                                                            {70, "toilet"},
                                                                            {72, "tv"},
                                                                            {82, "refrigerator"},
                                                                            {84, "book"},
                                                                            {90, "toothbrush"}}) {
    EXPECT_EQ(NameOf(map, label), name) << label;
  }
}

TEST(ClassMap, Coco91LeavesTenGapsAndUsesEveryClassOnce) {
  const ClassMap map = MakeCoco91ClassMap();
  ASSERT_EQ(map.size(), 91U);
  std::vector<std::uint32_t> used;
  for (const ClassId id : map) {
    if (id.valid()) used.push_back(id.value);
  }
  ASSERT_EQ(used.size(), CocoClassNames().size());
  for (std::size_t i = 0; i < used.size(); ++i) EXPECT_EQ(used[i], i);
  for (const int gap : {0, 12, 26, 29, 30, 45, 66, 68, 69, 71, 83}) {
    EXPECT_EQ(NameOf(map, gap), "none") << gap;
  }
}

TEST(ClassMap, ContiguousLabelsBeginAfterTheBackground) {
  const ClassMap map = MakeContiguousClassMap(80);
  EXPECT_EQ(NameOf(map, 0), "none");
  EXPECT_EQ(NameOf(map, 1), "person");
  EXPECT_EQ(NameOf(map, 12), "stop sign");
  EXPECT_EQ(NameOf(map, 80), "toothbrush");
}

TEST(ClassMap, LabelsOutsideHaveNoClass) {
  const ClassMap map = MakeContiguousClassMap(2);
  EXPECT_FALSE(FindClassOfLabel(map, 3).valid());
  EXPECT_FALSE(FindClassOfLabel(map, -1).valid());
  EXPECT_FALSE(FindClassOfLabel({}, 0).valid());
}

}  // namespace
}  // namespace ofm
