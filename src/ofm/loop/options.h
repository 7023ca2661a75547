#pragma once

#include "ofm/base/options.h"
#include "ofm/estimation/pose_graph.h"
#include "ofm/estimation/ransac.h"

namespace ofm {

/// Loop closing (figures as published for ORB-SLAM2).
struct LoopOptions {
  bool enabled = true;
  double similarity_share = 0.75;       ///< of the best neighbour's similarity, for a candidate
  int max_candidates = 3;               ///< checked for each keyframe
  int consistent_keyframes = 3;         ///< in a row whose candidates are neighbours
  int pause_keyframes = 10;             ///< after a loop, in which none is looked for
  int min_matches = 20;                 ///< by descriptor, with depth on both sides
  int min_alignment_inliers = 20;       ///< of RANSAC on these
  int min_inliers = 40;                 ///< after the guided search
  double min_static_probability = 0.5;  ///< of features and landmarks that take part
  int strong_covisibility = 100;        ///< shared landmarks that make an edge of the pose graph
  RansacLimits ransac{300, 0.99};
  PoseGraphOptions pose_graph = {};
  bool full_adjustment = true;  ///< bundle adjustment of the whole map after a loop

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled, "recognise places and close loops");
    visit("similarity_share", self.similarity_share,
          "of the best neighbour's similarity that makes a keyframe a candidate", Range{0, 1});
    visit("max_candidates", self.max_candidates, "candidates checked for each keyframe",
          Range{1, 100});
    visit("consistent_keyframes", self.consistent_keyframes,
          "keyframes in a row whose candidates must be neighbours", Range{1, 100});
    visit("pause_keyframes", self.pause_keyframes,
          "keyframes after a loop in which none is looked for", Range{0, 1000});
    visit("min_matches", self.min_matches, "matches by descriptor that a candidate needs",
          Range{3, 1000});
    visit("min_alignment_inliers", self.min_alignment_inliers,
          "of these that must agree on one rigid transform", Range{3, 1000});
    visit("min_inliers", self.min_inliers, "landmarks found with that transform", Range{3, 1000});
    visit("min_static_probability", self.min_static_probability,
          "of features and landmarks that take part in loops", Range{0, 1});
    visit("strong_covisibility", self.strong_covisibility,
          "shared landmarks that make an edge of the pose graph", Range{1, 10000});
    visit("ransac_iterations", self.ransac.iterations, "of the alignment at most",
          Range{1, 100000});
    visit("ransac_confidence", self.ransac.confidence, "at which the alignment ends early",
          Range{0.5, 0.999999});
    visit("pose_graph", self.pose_graph);
    visit("full_adjustment", self.full_adjustment,
          "bundle adjustment of the whole map after a loop");
  }
};

}  // namespace ofm
