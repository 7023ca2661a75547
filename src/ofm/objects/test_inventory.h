// A made inventory, for the tests of what reads and writes them. Tests only.
#pragma once

#include "ofm/objects/scene_object.h"

namespace ofm::test {

inline SceneObject MadeObject(std::uint32_t id, std::uint32_t class_id, double x) {
  SceneObject object;
  object.id = ObjectId(id);
  object.classes = {{ClassId(class_id), .75}, {ClassId(2), .25}};
  object.box = {{x, .5, 2}, Eigen::Quaterniond(.5, .5, -.5, .5), {.6, .4, .1 * (id + 1)}};
  object.centroid_in_world = {x, .25, 1.875};
  object.first_seen_ns = 1'305'031'453'359'684'000;
  object.last_seen_ns = 1'305'031'460'000'000'001;
  object.views = 4 + static_cast<int>(id);
  object.views_expected = 16;
  object.confidence = .25 / (id + 1);
  object.point_count = 321;
  object.color = {10, 20, 255};
  return object;
}

/// Two chairs at x = 1 and 3 m and a book at 2 m; one person walks.
inline ObjectInventory MadeInventory() {
  ObjectInventory inventory;
  inventory.class_names = {"person", "chair", "it's a \"cup\"", "book"};
  inventory.up_in_world = {0, -.8, -.6};
  inventory.objects = {MadeObject(0, 1, 1), MadeObject(1, 3, 2), MadeObject(2, 1, 3)};
  inventory.tracks = {{InstanceId(7),
                       ClassId(0),
                       .5,
                       {{5'000'000'000, {1, 2, 3}, .5}, {6'000'000'000, {1.5, 2, 3}, .75}}}};
  return inventory;
}

}  // namespace ofm::test
