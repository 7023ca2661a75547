// Which world a sequence is of.
#pragma once

#include "ofm/base/options.h"
#include "ofm/sim/furnished_plan.h"
#include "ofm/sim/room.h"
#include "ofm/sim/scene.h"

namespace ofm {

enum class SceneKind {
  kRoom,      ///< the small test room of MakeRoom
  kOffice,    ///< MakeOffice
  kCorridor,  ///< MakeCorridor
};
EnumNameList<SceneKind> EnumNames(SceneKind);

struct WorldOptions {
  SceneKind scene = SceneKind::kRoom;
  PeopleKind people = PeopleKind::kNone;  ///< of the furnished worlds; RoomOptions has the room's

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("scene", self.scene, "a small test room (see 'room'), or a furnished world");
    visit("people", self.people, "what people do in office and corridor");
  }
};

/// What a world is made from.
struct WorldPlan {
  WorldOptions world;
  RoomOptions room;         ///< of SceneKind::kRoom alone
  FurnishedPlan furnished;  ///< of the others; its `people` is that of `world`
};

Scene MakeWorld(const WorldPlan& plan);

}  // namespace ofm
