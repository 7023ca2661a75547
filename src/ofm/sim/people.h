// People in a furnished world: who they are, and what they do all the time.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ofm/sim/floor_graph.h"
#include "ofm/sim/human_script.h"
#include "ofm/sim/scene_kit.h"

namespace ofm {

using ScriptPtr = std::shared_ptr<const HumanScript>;
/// Where something is on the floor at a time.
using FloorTrack = std::function<Eigen::Vector2d(double time_s)>;

/// What a walker must stay away from.
struct KeepAway {
  FloorTrack track;
  double distance_m = 0.6;
};

struct WalkPlan {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  std::optional<Seat> seat;    ///< sits down there now and then
  std::vector<int> stops;      ///< places of the graph to go to and stay at
  double duration_s = 10;      ///< the plan covers at least that
  std::vector<KeepAway> away;  ///< as far as another way is found
};

/// Walks from stop to stop and rests there, and sits down sometimes.
HumanScript PlanWalks(SceneKit& kit, const FloorGraph& graph, const WalkPlan& plan);

/// Somebody with clothes of their own, class "person".
void AddHuman(SceneKit& kit, const ScriptPtr& script);
/// The same with a carton in their hands, class "box".
void AddCarrier(SceneKit& kit, const ScriptPtr& script);

/// A chair at `seat`, class "chair"; who sits in it pulls it up to the desk and pushes it back when
/// they stand up. Without `user` it stands still, pulled up.
void AddSeatChair(SceneKit& kit, const Seat& seat, const ScriptPtr& user);

/// A door leaf, class "door", about a hinge; it opens by a quarter turn, to the left of its
/// direction, while one of `users` is near. Without users it stands open.
struct DoorPlan {
  Eigen::Vector2d hinge = Eigen::Vector2d::Zero();
  double yaw_rad = 0;  ///< from the hinge along the closed leaf
  double width_m = 0.9, height_m = 2.03;
  std::vector<FloorTrack> users;
};
void AddDoor(SceneKit& kit, const DoorPlan& plan);

}  // namespace ofm
