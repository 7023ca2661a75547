// Who is in a furnished world, and for how long.
#pragma once

#include <cstdint>

#include "ofm/base/options.h"
#include "ofm/sim/camera_path.h"
#include "ofm/sim/people.h"

namespace ofm {

enum class PeopleKind {
  kNone,
  kSitting,  ///< at the desks; they talk and move their hands
  kWalking,  ///< about, close before the camera too; they sit down, and one carries a carton
};
EnumNameList<PeopleKind> EnumNames(PeopleKind);

struct FurnishedPlan {
  PeopleKind people = PeopleKind::kWalking;
  double duration_s = 10;  ///< people have plans for that long, and then stay where they are
  CameraPathOptions path;  ///< people keep away from the camera that goes it
  std::uint64_t seed = 1;  ///< decides the furniture and the people, but not the walls
};

/// Where people of a world can be.
struct PeoplePlaces {
  FloorGraph graph;
  std::vector<int> stops;               ///< places of the graph where walkers stay for a while
  std::vector<Seat> seats;              ///< the first two have users, if there are people
  std::vector<Eigen::Vector2d> starts;  ///< of the walkers
  bool has_carrier = false;             ///< the last walker carries a carton
};

/// Adds the people and the chairs of all seats. Gives the walkers' scripts.
std::vector<ScriptPtr> AddPeople(SceneKit& kit, const PeoplePlaces& places,
                                 const FurnishedPlan& plan, const Viewpoint& viewpoint);

}  // namespace ofm
