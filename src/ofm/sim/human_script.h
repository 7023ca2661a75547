// What a person does over time: walks, turns, sits down, stands up, waits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ofm/sim/skeleton.h"

namespace ofm {

/// A chair: where its middle is on the floor, and which way it looks.
struct Seat {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double yaw_rad = 0;

  Eigen::Vector2d Forward() const { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }
  /// Where one stands before sitting down: at the chair, which is then pushed back.
  Eigen::Vector2d StandingPlace() const { return position - 0.1 * Forward(); }
};

/// A person at one moment.
struct HumanState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< on the floor
  double yaw_rad = 0;
  double gait = 0;        ///< 0 stands, 1 walks
  double stride_rad = 0;  ///< where in the stride
  double sit = 0;         ///< 0 stands, 1 sits
  double liveliness = 0;  ///< of the hands and head, 0 to 1
};

/// A list of actions, one after the other from time 0; before and after them the person stands or
/// sits still. Immutable once built; threads may share it.
class HumanScript {
 public:
  HumanScript(const Eigen::Vector2d& position, double yaw_rad);
  /// Somebody who sits already.
  explicit HumanScript(const Seat& seat);

  /// Turns towards the way and goes along it, corners rounded.
  void Walk(const std::vector<Eigen::Vector2d>& way);
  void Turn(double yaw_rad);
  void SitDown(const Seat& seat);
  void StandUp();
  void Wait(double duration_s);

  double end_s() const { return end_s_; }
  Eigen::Vector2d end_position() const { return last_.position; }
  HumanState At(double time_s) const;

 private:
  struct Action {
    double begin_s, end_s;
    HumanState from, to;
    std::vector<Eigen::Vector2d> way;  ///< empty unless walking
    std::vector<double> lengths_m;     ///< along the way, to each of its corners
  };

  void Append(double duration_s, const HumanState& to);
  static HumanState Walking(const Action& action, double time_s);

  std::vector<Action> actions_;
  HumanState last_;
  double end_s_ = 0;
};

/// The joints of somebody in `state`; what the hands and the head do depends on `time_s` and on
/// `phase_rad`, by which people differ. `carries` is 1 for who holds something with both hands.
JointAngles FindJoints(const HumanState& state, double time_s, double phase_rad, double carries);

}  // namespace ofm
