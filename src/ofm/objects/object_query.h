// Which objects somebody asks for.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/objects/scene_object.h"

namespace ofm {

enum class ObjectOrder { kId, kClass, kDistance, kViews, kConfidence, kSize };

inline EnumNameList<ObjectOrder> EnumNames(ObjectOrder) {
  static constexpr std::array<std::pair<ObjectOrder, std::string_view>, 6> kNames{{
      {ObjectOrder::kId, "id"},
      {ObjectOrder::kClass, "class"},
      {ObjectOrder::kDistance, "distance"},
      {ObjectOrder::kViews, "views"},
      {ObjectOrder::kConfidence, "confidence"},
      {ObjectOrder::kSize, "size"},
  }};
  return kNames;
}

struct ObjectQuery {
  std::vector<std::string> classes;              ///< one of these; none = any
  std::optional<Eigen::Vector3d> near_in_world;  ///< [m]
  std::optional<double> radius_m;                ///< around it
  int min_views = 0;
  ObjectOrder order = ObjectOrder::kId;  ///< distance: nearest first; others of number: most
};

/// What a query asks for, and by how much each object is away from its place.
struct ObjectAnswer {
  std::vector<SceneObject> objects;
  std::vector<double> distances_m;  ///< from the centroids, by object; empty without a place
};

/// Throws Error for a class that is not among the inventory's, and for a radius or an order by
/// distance without a place.
ObjectAnswer SelectObjects(const ObjectInventory& inventory, const ObjectQuery& query);

}  // namespace ofm
