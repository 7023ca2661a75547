#pragma once

#include "ofm/base/options.h"
#include "ofm/estimation/bundle_adjustment.h"

namespace ofm {

/// Local mapping (figures as published for ORB-SLAM2).
struct MappingOptions {
  int min_close_landmarks = 600;        ///< features with depth that become landmarks even when far
  int neighbours = 10;                  ///< keyframes to triangulate and fuse with
  double min_found_ratio = 0.25;        ///< found / visible, under which a young landmark goes
  int min_observations = 2;             ///< of a landmark two keyframes after it was made
  double min_static_probability = 0.3;  ///< of a landmark; under it, it goes
  int max_bundle_keyframes = 20;        ///< free ones in local bundle adjustment
  int max_fixed_keyframes = 30;         ///< fixed ones
  double redundant_share = 0.9;         ///< of a keyframe's landmarks seen by three others: it goes
  int max_keyframes = 4000;             ///< of the whole map; the most redundant go over it
  int max_hamming = 50;                 ///< bits, when fusing and triangulating
  double min_parallax_deg = 1;          ///< when triangulating
  BundleOptions bundle = {};
  BundleOptions final_bundle{10, 20, 1};  ///< over the whole map, at the end

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("min_close_landmarks", self.min_close_landmarks,
          "features with depth that become landmarks even when far", Range{0, 10000});
    visit("neighbours", self.neighbours, "keyframes to triangulate and fuse with", Range{0, 1000});
    visit("min_found_ratio", self.min_found_ratio,
          "found to visible, under which a young landmark goes", Range{0, 1});
    visit("min_observations", self.min_observations,
          "observers that a landmark needs two keyframes after it was made", Range{1, 100});
    visit("min_static_probability", self.min_static_probability,
          "static probability under which a landmark goes", Range{0, 1});
    visit("max_bundle_keyframes", self.max_bundle_keyframes,
          "free keyframes in local bundle adjustment", Range{1, 1000});
    visit("max_fixed_keyframes", self.max_fixed_keyframes,
          "fixed keyframes in local bundle adjustment", Range{0, 1000});
    visit("redundant_share", self.redundant_share,
          "share of landmarks seen by three others that makes a keyframe redundant",
          Range{0, 1.01});
    visit("max_keyframes", self.max_keyframes,
          "keyframes held, of some 1 MB each; over it the most redundant go", Range{10, 10000000});
    visit("max_hamming", self.max_hamming, "descriptor distance when fusing [bits]", Range{1, 256});
    visit("min_parallax_deg", self.min_parallax_deg, "parallax when triangulating [deg]",
          Range{0, 90});
    visit("bundle", self.bundle);
    visit("final_bundle", self.final_bundle);
  }
};

}  // namespace ofm
