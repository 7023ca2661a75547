#include "ofm/sim/world.h"

#include <array>

#include "ofm/base/check.h"
#include "ofm/sim/corridor.h"
#include "ofm/sim/office.h"

namespace ofm {

EnumNameList<SceneKind> EnumNames(SceneKind) {
  static constexpr std::array<std::pair<SceneKind, std::string_view>, 3> kNames = {
      {{SceneKind::kRoom, "room"},
       {SceneKind::kOffice, "office"},
       {SceneKind::kCorridor, "corridor"}}};
  return kNames;
}

Scene MakeWorld(const WorldPlan& plan) {
  FurnishedPlan furnished = plan.furnished;
  furnished.people = plan.world.people;
  switch (plan.world.scene) {
    case SceneKind::kRoom:
      return MakeRoom(plan.room, plan.furnished.seed);
    case SceneKind::kOffice:
      return MakeOffice(furnished);
    case SceneKind::kCorridor:
      return MakeCorridor(furnished);
  }
  OFM_CHECK(false);
  return MakeRoom(plan.room, plan.furnished.seed);
}

}  // namespace ofm
