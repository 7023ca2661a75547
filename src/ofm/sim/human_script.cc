#include "ofm/sim/human_script.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ofm {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr double kSpeed_mps = 1.0;
constexpr double kStride_m = 1.35;  // two steps
constexpr double kSpeedUp_s = 0.5;
constexpr double kSitting_s = 1.5;

double SmoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// `yaw` plus whole turns, so that it is within half a turn of `near`.
double NearestTurn(double yaw, double near) {
  return yaw + 2 * kPi * std::round((near - yaw) / (2 * kPi));
}

double Heading(const Vector2d& direction) { return std::atan2(direction.y(), direction.x()); }

/// The point at `length_m` along a way.
Vector2d Along(const std::vector<Vector2d>& way, const std::vector<double>& lengths_m,
               double length_m) {
  if (length_m <= 0) return way.front();
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (length_m > lengths_m[i]) continue;
    const double ratio = (length_m - lengths_m[i - 1]) / (lengths_m[i] - lengths_m[i - 1]);
    return way[i - 1] + ratio * (way[i] - way[i - 1]);
  }
  return way.back();
}

/// The same with rounded corners: the mean over 0.7 m about it.
Vector2d RoundedAlong(const std::vector<Vector2d>& way, const std::vector<double>& lengths_m,
                      double length_m) {
  constexpr int kSamples = 7;
  const double reach = std::min({0.35, length_m, lengths_m.back() - length_m});
  Vector2d sum = Vector2d::Zero();
  for (int k = 0; k < kSamples; ++k) {
    const double offset = reach * (2.0 * k / (kSamples - 1) - 1);
    sum += Along(way, lengths_m, length_m + offset);
  }
  return sum / kSamples;
}

}  // namespace

HumanScript::HumanScript(const Vector2d& position, double yaw_rad) {
  last_.position = position;
  last_.yaw_rad = yaw_rad;
  last_.liveliness = 0.4;
}

HumanScript::HumanScript(const Seat& seat) : HumanScript(seat.position, seat.yaw_rad) {
  last_.sit = 1;
  last_.liveliness = 1;
}

void HumanScript::Append(double duration_s, const HumanState& to) {
  actions_.push_back({end_s_, end_s_ + duration_s, last_, to, {}, {}});
  last_ = to;
  end_s_ += duration_s;
}

void HumanScript::Turn(double yaw_rad) {
  constexpr double kRate_rad_per_s = 2.5;
  HumanState to = last_;
  to.yaw_rad = NearestTurn(yaw_rad, last_.yaw_rad);
  Append(0.1 + std::abs(to.yaw_rad - last_.yaw_rad) / kRate_rad_per_s, to);
}

void HumanScript::Walk(const std::vector<Vector2d>& way) {
  std::vector<Vector2d> corners = {last_.position};
  std::vector<double> lengths_m = {0};
  for (const Vector2d& corner : way) {
    const double step = (corner - corners.back()).norm();
    if (step < 0.05) continue;
    lengths_m.push_back(lengths_m.back() + step);
    corners.push_back(corner);
  }
  if (corners.size() < 2) return;
  Turn(Heading(corners[1] - corners[0]));
  HumanState to = last_;
  to.position = corners.back();
  to.yaw_rad = Heading(corners.back() - corners[corners.size() - 2]);
  to.stride_rad = last_.stride_rad + 2 * kPi * lengths_m.back() / kStride_m;
  Append(lengths_m.back() / kSpeed_mps + kSpeedUp_s, to);
  actions_.back().way = std::move(corners);
  actions_.back().lengths_m = std::move(lengths_m);
}

void HumanScript::SitDown(const Seat& seat) {
  Walk({seat.StandingPlace()});
  Turn(seat.yaw_rad);
  HumanState to = last_;
  to.position = seat.position;
  to.sit = 1;
  to.liveliness = 1;
  Append(kSitting_s, to);
}

void HumanScript::StandUp() {
  HumanState to = last_;
  to.position = last_.position - 0.1 * Vector2d(std::cos(last_.yaw_rad), std::sin(last_.yaw_rad));
  to.sit = 0;
  to.liveliness = 0.4;
  Append(kSitting_s, to);
}

void HumanScript::Wait(double duration_s) { Append(duration_s, last_); }

HumanState HumanScript::Walking(const Action& action, double time_s) {
  // The speed rises and falls in straight ramps.
  const double duration = action.end_s - action.begin_s;
  const double t = time_s - action.begin_s;
  const double length = action.lengths_m.back();
  const double ramp = std::min(kSpeedUp_s, 0.5 * duration);
  const double speed = length / (duration - ramp);
  double s = speed * (t - 0.5 * ramp);
  if (t < ramp) s = 0.5 * speed * t * t / ramp;
  if (t > duration - ramp) {
    s = length - 0.5 * speed * (duration - t) * (duration - t) / ramp;
  }
  HumanState state = action.from;
  state.position = RoundedAlong(action.way, action.lengths_m, s);
  const double behind = std::clamp(s - 0.15, 0.0, std::max(0.0, length - 0.3));
  const Vector2d ahead = RoundedAlong(action.way, action.lengths_m, std::min(behind + 0.3, length));
  state.yaw_rad = Heading(ahead - RoundedAlong(action.way, action.lengths_m, behind));
  state.gait = std::min({1.0, t / ramp, (duration - t) / ramp});
  state.stride_rad = action.from.stride_rad + 2 * kPi * s / kStride_m;
  return state;
}

HumanState HumanScript::At(double time_s) const {
  const auto after =
      std::upper_bound(actions_.begin(), actions_.end(), time_s,
                       [](double time, const Action& action) { return time < action.end_s; });
  if (after == actions_.end()) return last_;
  if (!after->way.empty()) return Walking(*after, time_s);
  const double ratio = SmoothStep((time_s - after->begin_s) / (after->end_s - after->begin_s));
  const HumanState& a = after->from;
  const HumanState& b = after->to;
  HumanState state = a;
  state.position += ratio * (b.position - a.position);
  state.yaw_rad += ratio * (b.yaw_rad - a.yaw_rad);
  state.sit += ratio * (b.sit - a.sit);
  state.liveliness += ratio * (b.liveliness - a.liveliness);
  // Small steps while turning.
  const double turn = std::abs(b.yaw_rad - a.yaw_rad);
  if (turn > 0.3) {
    state.gait = 0.35 * std::sin(kPi * ratio);
    state.stride_rad += 2.5 * turn * ratio;
  }
  return state;
}

JointAngles FindJoints(const HumanState& state, double time_s, double phase_rad, double carries) {
  constexpr double kSeatedPelvis_m = 0.57;
  JointAngles joints;
  const double sit = state.sit;
  const double stands = 1 - sit;
  const double bend = std::sin(kPi * sit);  // halfway one leans forwards
  const double slow = std::sin(1.1 * time_s + phase_rad);
  const double quick = std::sin(3.7 * time_s + 2 * phase_rad) * (0.6 + 0.4 * slow);
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1 : -1;
    const double swing = sign * std::sin(state.stride_rad);
    const double lift = std::max(0.0, sign * std::cos(state.stride_rad));
    joints.hip[side] = stands * state.gait * 0.45 * swing + sit * 1.45 + 0.2 * bend;
    joints.knee[side] = stands * state.gait * (0.12 + 0.85 * lift) + sit * 1.5 + 0.2 * bend;
    const double hands = state.liveliness * sign * quick;
    const double free = -0.45 * state.gait * swing + sit * (0.55 + 0.12 * hands) + 0.1 * hands;
    joints.shoulder[side] = (1 - carries) * free + carries * 0.45;
    joints.elbow[side] =
        (1 - carries) * (0.25 + 0.25 * state.gait + sit * (0.85 + 0.35 * hands)) + carries * 1.1;
    joints.spread[side] = 0.12 * sit + 0.05 * state.liveliness * slow * slow;
  }
  joints.lean =
      0.04 + 0.5 * bend + 0.05 * state.gait + sit * (0.08 + 0.08 * state.liveliness * slow);
  joints.twist =
      0.08 * state.gait * std::sin(state.stride_rad) + 0.12 * sit * state.liveliness * slow;
  joints.look = state.liveliness * 0.6 * std::sin(0.6 * time_s + 1.7 * phase_rad);
  joints.nod = 0.08 + 0.12 * state.liveliness * std::sin(0.9 * time_s + phase_rad);
  joints.pelvis_m = stands * StandingPelvis(joints) + sit * kSeatedPelvis_m;
  if (sit > 0) {
    JointAngles straight = joints;
    straight.hip = straight.knee = {0, 0};
    joints.pelvis_m = stands * StandingPelvis(straight) + sit * kSeatedPelvis_m;
  }
  return joints;
}

}  // namespace ofm
