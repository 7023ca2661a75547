#include "ofm/objects/object_query.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/objects/test_inventory.h"

namespace ofm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::uint32_t> Ids(const ObjectQuery& query) {
  std::vector<std::uint32_t> ids;
  for (const SceneObject& object : SelectObjects(test::MadeInventory(), query).objects) {
    ids.push_back(object.id.value);
  }
  return ids;
}

std::string ErrorOf(const ObjectQuery& query) {
  try {
    SelectObjects(test::MadeInventory(), query);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SelectObjects, GivesAllWhenNothingIsAsked) {
  EXPECT_THAT(Ids({}), ElementsAre(0, 1, 2));
  EXPECT_THAT(SelectObjects(test::MadeInventory(), {}).distances_m, IsEmpty());
}

TEST(SelectObjects, FiltersByClassViewsAndPlace) {
  ObjectQuery query;
  query.classes = {"chair"};
  EXPECT_THAT(Ids(query), ElementsAre(0, 2));
  query.classes = {"chair", "book"};
  query.min_views = 5;
  EXPECT_THAT(Ids(query), ElementsAre(1, 2));
  query.near_in_world = Eigen::Vector3d(3, .25, 1.875);
  query.radius_m = .5;
  EXPECT_THAT(Ids(query), ElementsAre(2));
  query.classes = {"person"};
  EXPECT_THAT(Ids(query), IsEmpty()) << "a class that is known, but no object's";
}

TEST(SelectObjects, SortsAsItIsTold) {
  ObjectQuery query;
  query.near_in_world = Eigen::Vector3d(2.9, .25, 1.875);
  query.order = ObjectOrder::kDistance;
  EXPECT_THAT(Ids(query), ElementsAre(2, 1, 0));
  EXPECT_NEAR(SelectObjects(test::MadeInventory(), query).distances_m[0], .1, 1e-9);
  for (const auto& [order, first] : {std::pair{ObjectOrder::kId, 0U},
                                     {ObjectOrder::kClass, 0U},
                                     {ObjectOrder::kViews, 2U},
                                     {ObjectOrder::kConfidence, 0U},
                                     {ObjectOrder::kSize, 2U}}) {
    query.order = order;
    EXPECT_EQ(Ids(query).front(), first) << static_cast<int>(order);
  }
}

TEST(SelectObjects, RefusesWhatItCannotAnswer) {
  ObjectQuery query;
  query.classes = {"chiar"};
  EXPECT_THAT(ErrorOf(query),
              HasSubstr("there is no class 'chiar'; objects are of the classes book, chair"));
  query = {};
  query.radius_m = 1;
  EXPECT_THAT(ErrorOf(query), HasSubstr("a radius needs a place"));
  query = {};
  query.order = ObjectOrder::kDistance;
  EXPECT_THAT(ErrorOf(query), HasSubstr("an order by distance needs a place"));
}

}  // namespace
}  // namespace ofm
