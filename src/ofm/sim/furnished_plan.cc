#include "ofm/sim/furnished_plan.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ofm {
namespace {

/// Nobody walks into the camera.
KeepAway AwayFromCamera(const CameraPath& path) {
  constexpr double kDistance_m = 0.7;
  return {[path](double time_s) -> Eigen::Vector2d {
            return path.WorldFromCamera(time_s).translation().head<2>();
          },
          kDistance_m};
}

FloorTrack TrackOf(const ScriptPtr& script) {
  return [script](double time_s) { return script->At(time_s).position; };
}

std::vector<ScriptPtr> PlanWalkers(SceneKit& kit, const PeoplePlaces& places,
                                   const FurnishedPlan& plan, const Viewpoint& viewpoint) {
  std::vector<ScriptPtr> scripts;
  std::vector<KeepAway> away = {AwayFromCamera(CameraPath(plan.path, viewpoint))};
  for (std::size_t k = 0; k < places.starts.size(); ++k) {
    WalkPlan walk{places.starts[k], {}, places.stops, plan.duration_s, away};
    const bool carries = places.has_carrier && k + 1 == places.starts.size();
    if (!carries && k < places.seats.size()) walk.seat = places.seats[k];
    scripts.push_back(std::make_shared<HumanScript>(PlanWalks(kit, places.graph, walk)));
    away.push_back({TrackOf(scripts.back()), 0.6});
  }
  return scripts;
}

}  // namespace

EnumNameList<PeopleKind> EnumNames(PeopleKind) {
  static constexpr std::array<std::pair<PeopleKind, std::string_view>, 3> kNames = {
      {{PeopleKind::kNone, "none"},
       {PeopleKind::kSitting, "sitting"},
       {PeopleKind::kWalking, "walking"}}};
  return kNames;
}

std::vector<ScriptPtr> AddPeople(SceneKit& kit, const PeoplePlaces& places,
                                 const FurnishedPlan& plan, const Viewpoint& viewpoint) {
  constexpr std::size_t kUsers = 2;
  constexpr std::uint64_t kPeopleStream = 2, kChairStream = 3, kLaterStream = 4;
  std::vector<ScriptPtr> users(places.seats.size()), walkers;
  kit.BeginStream(kPeopleStream);
  if (plan.people == PeopleKind::kWalking) walkers = PlanWalkers(kit, places, plan, viewpoint);
  for (std::size_t k = 0; k < std::min(kUsers, users.size()); ++k) {
    if (plan.people == PeopleKind::kSitting) {
      users[k] = std::make_shared<HumanScript>(places.seats[k]);
    } else if (k < walkers.size()) {
      users[k] = walkers[k];
    }
  }
  for (std::size_t k = 0; k < walkers.size(); ++k) {
    if (places.has_carrier && k + 1 == walkers.size()) {
      AddCarrier(kit, walkers[k]);
    } else {
      AddHuman(kit, walkers[k]);
    }
  }
  if (plan.people == PeopleKind::kSitting) {
    for (const ScriptPtr& user : users) {
      if (user != nullptr) AddHuman(kit, user);
    }
  }
  kit.BeginStream(kChairStream);
  for (std::size_t k = 0; k < users.size(); ++k) AddSeatChair(kit, places.seats[k], users[k]);
  kit.BeginStream(kLaterStream);
  return walkers;
}

}  // namespace ofm
