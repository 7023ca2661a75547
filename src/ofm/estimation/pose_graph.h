// Poses from relative poses between them: spreads what a loop tells over the way that led to it.
#pragma once

#include <stop_token>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/estimation/pose_graph_cost.h"

namespace ofm {

struct PoseGraphOptions {
  int iterations = 20;  ///< at most
  int threads = 1;      ///< of Ceres; 1 is bit-reproducible
  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("iterations", self.iterations, "iterations at most", Range{1, 1000});
    visit("threads", self.threads, "threads of the solver; 1 is bit-reproducible", Range{1, 64});
  }
};

/// Key frames by index, and what is known of pairs of them.
struct PoseGraphProblem {
  struct Pose {
    RigidTransform camera_from_world;  ///< where the optimisation starts
    bool fixed = false;                ///< at least one is: it holds the frame of reference
  };
  struct Edge {
    int source = 0, target = 0;         ///< indices into poses, not equal
    RigidTransform target_from_source;  ///< measured; of the two cameras
    RelativePoseSigma sigma;
  };
  std::vector<Pose> poses;
  std::vector<Edge> edges;
};

struct PoseGraphResult {
  std::vector<RigidTransform> camera_from_world;  ///< by pose
  double initial_cost = 0, final_cost = 0;        ///< half the sum of squared residuals
  bool usable = false;  ///< false where the solver failed or was stopped early
};

/// Minimises the squared residuals of all edges (Grisetti et al., A Tutorial on Graph-Based SLAM,
/// 2010) by Levenberg–Marquardt with a sparse factorisation. Poses without a way of edges to a
/// fixed one keep where they are. Where `stop` is requested the poses are those given.
PoseGraphResult OptimizePoseGraph(const PoseGraphProblem& problem, const PoseGraphOptions& options,
                                  std::stop_token stop = {});

}  // namespace ofm
