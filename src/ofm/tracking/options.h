#pragma once

#include "ofm/base/options.h"
#include "ofm/estimation/pnp.h"
#include "ofm/estimation/pose_optimizer.h"
#include "ofm/features/patch_alignment.h"

namespace ofm {

/// When a frame becomes a keyframe (figures as published for ORB-SLAM2).
struct KeyframeOptions {
  double inlier_ratio = 0.8;  ///< of the reference keyframe's landmarks; fewer call for a keyframe
  int max_frames = 30;        ///< since the last keyframe
  int min_inliers = 15;       ///< fewer make no keyframe
  int close_tracked = 100;    ///< fewer tracked close points call for a keyframe, …
  int close_untracked = 70;   ///< … where more than so many could be added
  int max_waiting = 3;        ///< keyframes that may wait for mapping

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("inlier_ratio", self.inlier_ratio,
          "a keyframe is made under this share of the reference's landmarks", Range{0.05, 1});
    visit("max_frames", self.max_frames, "frames after which a keyframe is made", Range{1, 10000});
    visit("min_inliers", self.min_inliers, "fewer inliers make no keyframe", Range{3, 1000});
    visit("close_tracked", self.close_tracked, "fewer tracked close points call for a keyframe",
          Range{0, 10000});
    visit("close_untracked", self.close_untracked,
          "where more close points than this are untracked", Range{0, 10000});
    visit("max_waiting", self.max_waiting, "keyframes that may wait for mapping", Range{1, 1000});
  }
};

/// Keyframes that are tried where the camera's place is not known.
struct RelocalizationOptions {
  int similar_keyframes = 10;  ///< that look most alike
  int near_keyframes = 5;      ///< about the last known place
  int spread_keyframes = 5;    ///< from all over the map, others in each frame

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("similar_keyframes", self.similar_keyframes, "tried because they look alike",
          Range{0, 1000});
    visit("near_keyframes", self.near_keyframes, "tried about the last known place",
          Range{0, 1000});
    visit("spread_keyframes", self.spread_keyframes, "tried all over the map, others in each frame",
          Range{0, 1000});
  }
};

/// How far the camera is followed without any landmark, by its motion from frame to frame.
struct DeadReckoningOptions {
  double max_s = 0.7;       ///< since the last frame with landmarks; then it is lost
  double keyframe_s = 0.1;  ///< after which the map is continued from what is seen now
  int min_features = 300;   ///< with depth, for that

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("max_s", self.max_s, "without landmarks the camera is lost after this [s]; 0 = at once",
          Range{0, 60});
    visit("keyframe_s", self.keyframe_s,
          "without landmarks the map is continued by a new keyframe after this [s]", Range{0, 60});
    visit("min_features", self.min_features, "features with depth that such a keyframe needs",
          Range{10, 100000});
  }
};

/// When a lost camera begins a new sub-map.
struct SubmapOptions {
  bool enabled = true;
  double begin_after_s = 0.3;  ///< since the first frame of a loss that shows enough to begin one

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled, "begin a new sub-map where the camera stays lost");
    visit("begin_after_s", self.begin_after_s,
          "since the first lost frame that shows enough to begin a map [s]", Range{0, 3600});
  }
};

/// How features are laid over the view of the keyframe that made their landmark.
struct MatchAlignmentOptions {
  bool enabled = true;
  PatchAlignmentOptions patch = {};
  double noise_scale = 2;   ///< of aligned places over their typical residual: it has long tails
  double min_noise = 0.25;  ///< of aligned places, over that of corners
  double depth_noise_scale = 2;  ///< of inverse depth over its typical residual
  double min_depth_noise = 0.1;  ///< of inverse depth, over measurement.inverse_depth_sigma

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled,
          "lay features over the keyframe that made their landmark: places to a small part of a "
          "pixel");
    visit("patch", self.patch);
    visit("noise_scale", self.noise_scale,
          "noise of aligned features over the sigma of a frame's typical residual", Range{0.1, 10});
    visit("min_noise", self.min_noise,
          "noise of aligned features at least, over measurement.pixel_sigma", Range{0.01, 1});
    visit("depth_noise_scale", self.depth_noise_scale,
          "noise of inverse depth over the sigma of a frame's typical residual", Range{0.1, 1000});
    visit("min_depth_noise", self.min_depth_noise,
          "noise of inverse depth at least, over measurement.inverse_depth_sigma; 1 = it is not "
          "measured",
          Range{0.01, 1});
  }
};

struct TrackingOptions {
  int min_start_features = 300;  ///< with depth, to begin a map
  double search_radius_px = 15;  ///< frame to frame, at octave 0
  int min_motion_matches =
      20;                      ///< fewer widen the search, then fall back to the reference keyframe
  int min_frame_inliers = 10;  ///< frame to frame
  int min_map_inliers = 30;    ///< against the local map; fewer are a loss
  double doubtful_share = 0.4;  ///< of the last frame's inliers; fewer call for a second opinion
  int min_relocalization_inliers = 50;
  int max_local_keyframes = 60;
  int max_hamming = 100;     ///< bits
  double ratio = 0.9;        ///< best to second best distance, frame to frame
  double map_ratio = 0.8;    ///< the same, against the local map
  double map_radius_px = 3;  ///< multiplies the local map's search radius of 2.5 or 4
  DeadReckoningOptions dead_reckoning;
  RelocalizationOptions relocalization;
  SubmapOptions submap;
  KeyframeOptions keyframe;
  MatchAlignmentOptions alignment;
  PoseOptimizerOptions pose;
  PnpOptions pnp;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min_start_features", self.min_start_features, "features with depth that begin a map",
          Range{10, 100000});
    visit("search_radius_px", self.search_radius_px, "frame-to-frame search at octave 0 [px]",
          Range{1, 200});
    visit("min_motion_matches", self.min_motion_matches,
          "fewer matches widen the search, then try the reference keyframe", Range{4, 1000});
    visit("min_frame_inliers", self.min_frame_inliers, "inliers needed frame to frame",
          Range{4, 1000});
    visit("min_map_inliers", self.min_map_inliers, "inliers needed against the local map",
          Range{4, 1000});
    visit("doubtful_share", self.doubtful_share,
          "share of the last frame's inliers under which the keyframe is asked too", Range{0, 1});
    visit("min_relocalization_inliers", self.min_relocalization_inliers,
          "inliers needed to relocalise", Range{4, 1000});
    visit("max_local_keyframes", self.max_local_keyframes, "keyframes of the local map at most",
          Range{1, 10000});
    visit("max_hamming", self.max_hamming, "descriptor distance of a match at most [bits]",
          Range{1, 256});
    visit("ratio", self.ratio, "best to second best distance, frame to frame", Range{0.1, 1});
    visit("map_ratio", self.map_ratio, "best to second best distance, local map", Range{0.1, 1});
    visit("map_radius_px", self.map_radius_px, "scales the local map's search radius",
          Range{0.1, 50});
    visit("dead_reckoning", self.dead_reckoning);
    visit("relocalization", self.relocalization);
    visit("submap", self.submap);
    visit("keyframe", self.keyframe);
    visit("alignment", self.alignment);
    visit("pose", self.pose);
    visit("pnp", self.pnp);
  }
};

}  // namespace ofm
