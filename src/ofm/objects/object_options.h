// Settings of the object database.
#pragma once

#include "ofm/base/options.h"

namespace ofm {

/// What of an instance in a key frame is kept.
struct ObjectObservationOptions {
  double min_score = 0.25;       ///< instances that the network is less sure of are left out
  double max_moving_share = .5;  ///< of the instance's pixels; with more it is no standing object
  int erosion_px = 2;            ///< masks are often too large by this
  double depth_margin_m = 0.2;   ///< what is farther from the object's depths is background
  double range_m = 4;            ///< farther points are too noisy
  double point_spacing_m = .02;  ///< one point per voxel of this side is kept
  int min_points = 15;           ///< with fewer an instance is left out

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min_score", self.min_score, "instances of a lower score are left out", Range{0, 1});
    visit("max_moving_share", self.max_moving_share,
          "of an instance's pixels; with more it is no standing object", Range{0, 1});
    visit("erosion_px", self.erosion_px, "by which masks are made smaller [px]", Range{0, 100});
    visit("depth_margin_m", self.depth_margin_m,
          "what is farther from the object's depths is background [m]", Range{0.01, 10});
    visit("range_m", self.range_m, "farther points are left out [m]", Range{0.1, 50});
    visit("point_spacing_m", self.point_spacing_m, "one point per voxel of this side [m]",
          Range{.002, 1});
    visit("min_points", self.min_points, "instances of fewer points are left out", Range{1, 1e6});
  }
};

/// Which observations are one object, and which objects are believed.
struct ObjectJoinOptions {
  double voxel_m = 0.04;              ///< side of the voxels in which overlap is measured
  double same_class_overlap = 0.35;   ///< share of the smaller one that must be in the other
  double other_class_overlap = 0.5;   ///< share of either that must be in the other
  double max_seen_apart_share = .25;  ///< of the views, in which two objects of a class are two
  double same_class_spreads = 2;      ///< nearer than so many spreads of the larger: one thing
  double other_class_spreads = 1;     ///< of different classes: of the smaller
  double part_overlap = 0.7;          ///< share of a part that is in its whole
  double part_min_size = 0.2;         ///< of the whole's voxels; what is smaller lies on it
  double part_max_weight = 0.4;       ///< of the whole's summed scores
  int min_views = 2;                  ///< key frames that must have seen an object
  double min_confidence = 0.14;       ///< summed scores / key frames that should have seen it
  double min_visible_share = 0.6;     ///< of an object's voxels, in a key frame that should see it
  double depth_tolerance_m = 0.06;    ///< between an object's voxel and what is seen there
  int border_px = 12;                 ///< nearer to the image's border nothing need be seen

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("voxel_m", self.voxel_m, "side of the voxels in which overlap is measured [m]",
          Range{.005, 1});
    visit("same_class_overlap", self.same_class_overlap,
          "share of the smaller one that must be in the other", Range{0.01, 1});
    visit("other_class_overlap", self.other_class_overlap,
          "of different classes: share of either that must be in the other", Range{0.01, 1});
    visit("max_seen_apart_share", self.max_seen_apart_share,
          "of the views, in which two of a class were told apart; with more they stay two",
          Range{0, 1});
    visit("same_class_spreads", self.same_class_spreads,
          "distance / the larger one's spread, under which two never seen apart are one",
          Range{0, 100});
    visit("other_class_spreads", self.other_class_spreads,
          "distance / the smaller one's spread, under which two of like size are one",
          Range{0, 100});
    visit("part_overlap", self.part_overlap, "share of a part that is in its whole",
          Range{0.01, 1});
    visit("part_min_size", self.part_min_size, "of the whole's voxels; smaller things lie on it",
          Range{0, 1});
    visit("part_max_weight", self.part_max_weight,
          "summed scores of a part / of its whole, at most", Range{0, 10});
    visit("min_views", self.min_views, "key frames that must have seen an object",
          Range{1, 100000});
    visit("min_confidence", self.min_confidence,
          "summed scores / key frames that should have seen the object", Range{0, 1});
    visit("min_visible_share", self.min_visible_share,
          "of an object's voxels, in a key frame that should see it", Range{0.01, 1});
    visit("depth_tolerance_m", self.depth_tolerance_m,
          "between an object's voxel and what is seen there [m]", Range{0, 10});
    visit("border_px", self.border_px, "nearer to the image's border nothing need be seen [px]",
          Range{0, 10000});
  }
};

/// Where what moves was.
struct ObjectTrackOptions {
  double min_duration_s = 0.5;  ///< shorter tracks are left out
  double speed_window_s = 0.6;  ///< over which speed is measured

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min_duration_s", self.min_duration_s, "shorter tracks are left out [s]", Range{0, 3600});
    visit("speed_window_s", self.speed_window_s, "over which speed is measured [s]",
          Range{0.01, 60});
  }
};

struct ObjectOptions {
  ObjectObservationOptions observation = {};
  ObjectJoinOptions join = {};
  ObjectTrackOptions tracks = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("observation", self.observation, "what of an instance in a key frame is kept");
    visit("join", self.join, "which observations are one object");
    visit("tracks", self.tracks, "of what moves");
  }
};

}  // namespace ofm
