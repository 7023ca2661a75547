#include "ofm/objects/object_query.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "ofm/base/error.h"
#include "ofm/perception/class_names.h"

namespace ofm {
namespace {

struct Found {
  SceneObject object;
  double distance_m = 0;
};

void RequireValid(const ObjectInventory& inventory, const ObjectQuery& query) {
  for (const std::string& name : query.classes) {
    if (FindClass(inventory.class_names, name).valid()) continue;
    std::set<std::string> there;
    for (const SceneObject& object : inventory.objects) {
      there.insert(inventory.class_names[object.class_id().value]);
    }
    throw Error(fmt::format("there is no class '{}'; objects are of the classes {}", name,
                            there.empty() ? "(none)" : fmt::format("{}", fmt::join(there, ", "))));
  }
  if (query.near_in_world) return;
  if (query.radius_m) throw Error("a radius needs a place: --near X,Y,Z");
  if (query.order == ObjectOrder::kDistance) {
    throw Error("an order by distance needs a place: --near X,Y,Z");
  }
}

/// What comes first has the smaller key.
double SortKey(const Found& found, ObjectOrder order) {
  switch (order) {
    case ObjectOrder::kId:
      return found.object.id.value;
    case ObjectOrder::kClass:
      return found.object.class_id().value;
    case ObjectOrder::kDistance:
      return found.distance_m;
    case ObjectOrder::kViews:
      return -found.object.views;
    case ObjectOrder::kConfidence:
      return -found.object.confidence;
    case ObjectOrder::kSize:
      return -found.object.box.size_m.norm();
  }
  return 0;
}

}  // namespace

ObjectAnswer SelectObjects(const ObjectInventory& inventory, const ObjectQuery& query) {
  RequireValid(inventory, query);
  std::vector<Found> found;
  for (const SceneObject& object : inventory.objects) {
    const std::string& name = inventory.class_names[object.class_id().value];
    if (!query.classes.empty() && std::ranges::find(query.classes, name) == query.classes.end()) {
      continue;
    }
    if (object.views < query.min_views) continue;
    double distance_m = 0;
    if (query.near_in_world) {
      distance_m = (object.centroid_in_world - *query.near_in_world).norm();
      if (query.radius_m && distance_m > *query.radius_m) continue;
    }
    found.push_back({object, distance_m});
  }
  std::ranges::stable_sort(found, {},
                           [&](const Found& candidate) { return SortKey(candidate, query.order); });
  ObjectAnswer answer;
  for (Found& one : found) {
    answer.objects.push_back(std::move(one.object));
    if (query.near_in_world) answer.distances_m.push_back(one.distance_m);
  }
  return answer;
}

}  // namespace ofm
