#include "ofm/objects/object_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ofm/objects/test_inventory.h"

namespace ofm {
namespace {

using nlohmann::json;

TEST(ObjectsJson, HasEveryFieldOfObjectsAndTracks) {
  const json all = json::parse(ObjectsJson(test::MadeInventory()));
  EXPECT_EQ(all["version"], 1);
  EXPECT_EQ(all["frame"], "world");
  EXPECT_EQ(all["up"], json({0.0, -0.8, -0.6}));
  ASSERT_EQ(all["objects"].size(), 3U);
  const json& book = all["objects"][1];
  EXPECT_EQ(book["id"], 1);
  EXPECT_EQ(book["class"], "book");
  EXPECT_EQ(book["probabilities"], json({{"book", 0.75}, {"it's a \"cup\"", 0.25}}));
  EXPECT_EQ(book["centroid_m"], json({2.0, 0.25, 1.875}));
  EXPECT_EQ(book["box"]["center_m"], json({2.0, 0.5, 2.0}));
  EXPECT_EQ(book["box"]["world_from_box"], json({0.5, -0.5, 0.5, 0.5})) << "x, y, z, w";
  EXPECT_EQ(book["box"]["size_m"], json({0.6, 0.4, 0.2}));
  EXPECT_EQ(book["first_seen"], "1305031453.359684");
  EXPECT_EQ(book["views"], 5);
  EXPECT_EQ(book["views_expected"], 16);
  EXPECT_EQ(book["confidence"], 0.125);
  EXPECT_EQ(book["points"], 321);
  EXPECT_EQ(book["color"], json({10, 20, 255}));
  ASSERT_EQ(all["tracks"].size(), 1U);
  EXPECT_EQ(all["tracks"][0]["class"], "person");
  EXPECT_EQ(all["tracks"][0]["points"][1],
            json({{"stamp", "6.000000"}, {"position_m", {1.5, 2.0, 3.0}}, {"speed_m_s", 0.75}}));
}

TEST(ObjectsJson, OfNothingHasEmptyLists) {
  const json all = json::parse(ObjectsJson({}));
  EXPECT_TRUE(all["objects"].is_array() && all["objects"].empty());
  EXPECT_TRUE(all["tracks"].is_array() && all["tracks"].empty());
}

}  // namespace
}  // namespace ofm
