#include "ofm/estimation/pose_system.h"

#include <cmath>

#include "ofm/base/check.h"
#include "ofm/estimation/reprojection.h"

namespace ofm {
namespace {

/// In place of the infinite chi-square of a point behind the camera: over every gate, and so much
/// that no step pays that brings a good point there.
constexpr double kBehindChiSquare = 1e6;

DoublePair Both(double value) { return DoublePair{value, value}; }

double Sum(DoublePair pair) { return pair[0] + pair[1]; }

}  // namespace

/// The upper triangle of the Hessian without its one zero, (0, 1), and the right-hand side.
struct PoseSystem::Sums {
  DoublePair h00{}, h02{}, h03{}, h04{}, h05{}, h11{}, h12{}, h13{}, h14{}, h15{};
  DoublePair h22{}, h23{}, h24{}, h25{}, h33{}, h34{}, h35{}, h44{}, h45{}, h55{};
  DoublePair b0{}, b1{}, b2{}, b3{}, b4{}, b5{};  ///< minus the gradient
  DoublePair twice_cost{};
};

PoseSystem::PoseSystem(const PinholeCamera& camera, std::span<const PoseObservation> observations,
                       double gate_scale)
    : count_(observations.size()), lanes_((observations.size() + 1) / 2) {
  if (count_ % 2) lanes_.back() = Lanes{};  // the spare lane is never active
  for (std::size_t i = 0; i < count_; ++i) {
    const auto& [point, seen] = observations[i];
    OFM_CHECK(IsValid(seen) && point.allFinite());
    Lanes& lanes = lanes_[i / 2];
    const std::size_t lane = i % 2;
    lanes.x[lane] = point.x(), lanes.y[lane] = point.y(), lanes.z[lane] = point.z();
    lanes.u[lane] = (seen.ideal_px.x() - camera.cx) / camera.fx;
    lanes.v[lane] = (seen.ideal_px.y() - camera.cy) / camera.fy;
    const double u_scale = camera.fx / seen.pixel_sigma, v_scale = camera.fy / seen.pixel_sigma;
    lanes.u_information[lane] = u_scale * u_scale;
    lanes.v_information[lane] = v_scale * v_scale;
    const double depth_sigma = seen.inverse_depth_sigma;
    lanes.inverse_depth[lane] = HasDepth(seen) ? 1 / seen.depth_m : 0;
    lanes.inverse_depth_information[lane] = HasDepth(seen) ? 1 / (depth_sigma * depth_sigma) : 0;
    lanes.gate[lane] = ChiSquareGate(seen) * gate_scale;
    lanes.weight[lane] = seen.weight;
    lanes.active[lane] = 1;
  }
}

void PoseSystem::Accumulate(Lanes& lanes, const Eigen::Matrix<double, 3, 4>& pose,
                            RobustKernel kernel, Sums& sums) {
  const auto row = [&](int r) {
    return pose(r, 0) * lanes.x + pose(r, 1) * lanes.y + pose(r, 2) * lanes.z + pose(r, 3);
  };
  const DoublePair depth = row(2);
  const auto before = depth > kMinPointDepth_m;
  const DoublePair q = 1.0 / (before ? depth : Both(1));
  const DoublePair a = row(0) * q, b = row(1) * q;
  const DoublePair du = lanes.u - a, dv = lanes.v - b, dq = lanes.inverse_depth - q;
  const DoublePair chi2 = du * du * lanes.u_information + dv * dv * lanes.v_information +
                          dq * dq * lanes.inverse_depth_information;
  lanes.chi2 = before ? chi2 : Both(kBehindChiSquare);

  DoublePair weight = lanes.weight * lanes.active;
  DoublePair kernel_of_chi2 = lanes.chi2;
  DoublePair kernel_weight = Both(1);
  if (kernel == RobustKernel::kHuber) {
    for (int lane = 0; lane < 2; ++lane) {
      if (lanes.chi2[lane] <= lanes.gate[lane]) continue;
      const double root = std::sqrt(lanes.chi2[lane] * lanes.gate[lane]);
      kernel_of_chi2[lane] = 2 * root - lanes.gate[lane];
      kernel_weight[lane] = lanes.gate[lane] / root;
    }
  }
  sums.twice_cost += weight * kernel_of_chi2;
  weight = before ? weight * kernel_weight : Both(0);

  // Derivatives of the predicted (u, v, inverse depth) by (rho, omega):
  //   u: ( q  0  -aq  -ab      1 + aa  -b )
  //   v: ( 0  q  -bq  -1 - bb  ab       a )
  //   d: ( 0  0  -qq  -bq      aq       0 )
  const DoublePair aq = a * q, bq = b * q, qq = q * q, ab = a * b;
  const DoublePair aa = 1.0 + a * a, bb = 1.0 + b * b;
  const DoublePair wu = weight * lanes.u_information, wv = weight * lanes.v_information;
  const DoublePair wd = weight * lanes.inverse_depth_information;
  const DoublePair u0 = wu * q, u2 = -wu * aq, u3 = -wu * ab, u4 = wu * aa, u5 = -wu * b;
  const DoublePair v1 = wv * q, v2 = -wv * bq, v3 = -wv * bb, v4 = wv * ab, v5 = wv * a;
  const DoublePair d2 = -wd * qq, d3 = -wd * bq, d4 = wd * aq;

  sums.h00 += u0 * q;
  sums.h02 -= u0 * aq;
  sums.h03 -= u0 * ab;
  sums.h04 += u0 * aa;
  sums.h05 -= u0 * b;
  sums.h11 += v1 * q;
  sums.h12 -= v1 * bq;
  sums.h13 -= v1 * bb;
  sums.h14 += v1 * ab;
  sums.h15 += v1 * a;
  sums.h22 -= u2 * aq + v2 * bq + d2 * qq;
  sums.h23 -= u2 * ab + v2 * bb + d2 * bq;
  sums.h24 += u2 * aa + v2 * ab + d2 * aq;
  sums.h25 += v2 * a - u2 * b;
  sums.h33 -= u3 * ab + v3 * bb + d3 * bq;
  sums.h34 += u3 * aa + v3 * ab + d3 * aq;
  sums.h35 += v3 * a - u3 * b;
  sums.h44 += u4 * aa + v4 * ab + d4 * aq;
  sums.h45 += v4 * a - u4 * b;
  sums.h55 += v5 * a - u5 * b;
  sums.b0 += u0 * du;
  sums.b1 += v1 * dv;
  sums.b2 += u2 * du + v2 * dv + d2 * dq;
  sums.b3 += u3 * du + v3 * dv + d3 * dq;
  sums.b4 += u4 * du + v4 * dv + d4 * dq;
  sums.b5 += u5 * du + v5 * dv;
}

NormalEquations PoseSystem::Linearize(const RigidTransform& camera_from_world,
                                      RobustKernel kernel) {
  Eigen::Matrix<double, 3, 4> pose;
  pose << camera_from_world.RotationMatrix(), camera_from_world.translation();
  Sums s;
  for (Lanes& lanes : lanes_) Accumulate(lanes, pose, kernel, s);

  NormalEquations equations;
  auto& h = equations.hessian;
  h.row(0) << Sum(s.h00), 0, Sum(s.h02), Sum(s.h03), Sum(s.h04), Sum(s.h05);
  h.row(1) << 0, Sum(s.h11), Sum(s.h12), Sum(s.h13), Sum(s.h14), Sum(s.h15);
  h.row(2) << 0, 0, Sum(s.h22), Sum(s.h23), Sum(s.h24), Sum(s.h25);
  h.row(3) << 0, 0, 0, Sum(s.h33), Sum(s.h34), Sum(s.h35);
  h.row(4) << 0, 0, 0, 0, Sum(s.h44), Sum(s.h45);
  h.row(5) << 0, 0, 0, 0, 0, Sum(s.h55);
  h.triangularView<Eigen::StrictlyLower>() = h.transpose();
  equations.gradient << -Sum(s.b0), -Sum(s.b1), -Sum(s.b2), -Sum(s.b3), -Sum(s.b4), -Sum(s.b5);
  equations.cost = 0.5 * Sum(s.twice_cost);
  return equations;
}

PoseSystem::Classification PoseSystem::ClassifyByGate() {
  Classification result;
  for (std::size_t i = 0; i < count_; ++i) {
    Lanes& lanes = lanes_[i / 2];
    const std::size_t lane = i % 2;
    const double active = lanes.chi2[lane] <= lanes.gate[lane] ? 1 : 0;
    result.active += active != 0;
    result.changed += active != lanes.active[lane];
    lanes.active[lane] = active;
  }
  return result;
}

}  // namespace ofm
