// How motion is judged on the lattice (dynamics mode `full`).
#pragma once

#include "ofm/base/options.h"
#include "ofm/perception/lattice_options.h"

namespace ofm {

/// The camera's own motion between two frames, by flow on what is believed static.
struct CameraMotionOptions {
  int block_cells = 4;               ///< one point is taken of each block of this side
  double pixel_sigma = 0.5;          ///< of the flow [px]
  double doubtful_share = 0.5;       ///< fewer inliers: RANSAC is asked as well
  double blurred_share = 0.25;       ///< fewer inliers still: flow is taken for blurred
  double blurred_pixel_sigma = 1.5;  ///< of blurred flow [px]; no better than that, no motion
  int ransac_iterations = 100;
  int min_points = 30;  ///< fewer give no motion: constant velocity is assumed

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("block_cells", self.block_cells, "one point is taken of each block of cells of this side",
          Range{1, 64});
    visit("pixel_sigma", self.pixel_sigma, "standard deviation of the flow [px]", Range{0.05, 20});
    visit("doubtful_share", self.doubtful_share, "a smaller share of inliers: RANSAC is asked too",
          Range{0, 1});
    visit("blurred_share", self.blurred_share,
          "a smaller share still: flow is taken for blurred; and then: no motion is believed",
          Range{0, 1});
    visit("blurred_pixel_sigma", self.blurred_pixel_sigma,
          "standard deviation of the flow in blurred images [px]", Range{0.05, 20});
    visit("ransac_iterations", self.ransac_iterations, "of RANSAC, at most", Range{1, 10000});
    visit("min_points", self.min_points, "fewer points: constant velocity is assumed",
          Range{6, 10000});
  }
};

/// What differs from the flow that the camera's motion explains.
struct FlowEvidenceOptions {
  double pixel_sigma = 1;             ///< of the residual at rest [px]
  double sigma_per_px = 0.03;         ///< added per pixel of flow
  double inverse_depth_sigma = 0.03;  ///< of the residual along the ray [1/m]
  double static_log_odds = -1.5;      ///< what a cell without residual says
  double moving_log_odds = 5;         ///< what a large residual says, at most
  double indifferent_chi_square = 3;  ///< squared residual in sigmas that says nothing

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("pixel_sigma", self.pixel_sigma, "of the residual at rest [px]", Range{0.05, 20});
    visit("sigma_per_px", self.sigma_per_px, "added per pixel of flow", Range{0, 1});
    visit("inverse_depth_sigma", self.inverse_depth_sigma, "of the residual along the ray [1/m]",
          Range{1e-4, 10});
    visit("static_log_odds", self.static_log_odds, "of a cell without residual", Range{-10, 0});
    visit("moving_log_odds", self.moving_log_odds, "of a cell with a large one", Range{0, 10});
    visit("indifferent_chi_square", self.indifferent_chi_square,
          "squared residual in sigmas that says nothing", Range{0.1, 100});
  }
};

/// What stands where an earlier view looked through.
struct FreeSpaceOptions {
  double margin_m = 0.08;          ///< the earlier view must have looked deeper by this
  double margin_per_metre = 0.03;  ///< and this much per metre of depth
  double log_odds = 1.5;           ///< of a cell that stands in once free space
  double static_log_odds = -0.1;   ///< per earlier view that saw the same surface there
  double interval_s = 0.1;         ///< between views kept
  double memory_s = 3.2;           ///< how long views are kept

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("margin_m", self.margin_m, "by which an earlier view must have looked deeper [m]",
          Range{0.005, 10});
    visit("margin_per_metre", self.margin_per_metre, "more margin per metre of depth", Range{0, 1});
    visit("log_odds", self.log_odds, "of a cell in once free space", Range{0, 10});
    visit("static_log_odds", self.static_log_odds, "per earlier view of the same surface",
          Range{-10, 0});
    visit("interval_s", self.interval_s, "between views kept [s]", Range{0.01, 10});
    visit("memory_s", self.memory_s, "how long views are kept [s]; 0 = none", Range{0, 60});
  }
};

/// How cells agree with their neighbours and with their past.
struct BeliefOptions {
  double prior_log_odds = -0.5;  ///< added in each frame: most things stand still
  double decay = 0.6;            ///< of the belief from one frame to the next
  double limit = 4;              ///< belief stays within plus and minus this
  double verdict = 2;            ///< over which a cell is masked; below it weighs less
  double coupling = 0.25;        ///< to each neighbour of equal depth
  int iterations = 5;            ///< of relaxation

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("prior_log_odds", self.prior_log_odds, "added in each frame", Range{-5, 5});
    visit("decay", self.decay, "of the belief from frame to frame", Range{0, 1});
    visit("limit", self.limit, "of the belief's absolute value", Range{0.1, 20});
    visit("verdict", self.verdict, "belief over which a cell is masked; below it weighs less",
          Range{-20, 20});
    visit("coupling", self.coupling, "to each neighbour of equal depth", Range{0, 1});
    visit("iterations", self.iterations, "of relaxation", Range{0, 100});
  }
};

struct MotionOptions {
  LatticeOptions lattice = {};  ///< masks are carried on it, too
  int dilation_px = 1;          ///< radius by which the mask grows
  CameraMotionOptions camera_motion = {};
  FlowEvidenceOptions flow = {};
  FreeSpaceOptions free_space = {};
  BeliefOptions belief = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("lattice", self.lattice, "the cells that motion is judged and masks are carried on");
    visit("dilation_px", self.dilation_px, "radius by which the mask grows [px]", Range{0, 100});
    visit("camera_motion", self.camera_motion, "the camera's own motion between frames");
    visit("flow", self.flow, "evidence from optical flow");
    visit("free_space", self.free_space, "evidence from space that was seen to be empty");
    visit("belief", self.belief, "how evidence is joined over space and time");
  }
};

}  // namespace ofm
