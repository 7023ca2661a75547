// How moving things are told from static ones.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/dynamics/instance_motion.h"
#include "ofm/dynamics/instance_tracker.h"
#include "ofm/dynamics/mask_refinement.h"
#include "ofm/dynamics/motion_options.h"

namespace ofm {

enum class DynamicsMode {
  kOff,    ///< everything is static
  kPaper,  ///< instances of dynamic classes and points off their epipolar line are dynamic
  kFull,   ///< whatever moves, by flow, depth, instances and what was believed before
};

inline EnumNameList<DynamicsMode> EnumNames(DynamicsMode) {
  static constexpr std::array<std::pair<DynamicsMode, std::string_view>, 3> kNames{{
      {DynamicsMode::kOff, "off"},
      {DynamicsMode::kPaper, "paper"},
      {DynamicsMode::kFull, "full"},
  }};
  return kNames;
}

/// Two-view geometry of the static scene and the distance from it that means motion.
struct EpipolarOptions {
  double threshold_px = 6;         ///< farther from its epipolar line a point moves
  double ransac_threshold_px = 1;  ///< within which a point supports a fundamental matrix
  double ransac_confidence = 0.99;
  int ransac_iterations = 500;    ///< at most
  int min_points = 30;            ///< fewer static candidates give no verdict
  double min_inlier_share = 0.8;  ///< of the candidates; below, the matrix is not believed

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("threshold_px", self.threshold_px, "distance to the epipolar line that means motion [px]",
          Range{0.1, 1000});
    visit("ransac_threshold_px", self.ransac_threshold_px,
          "distance within which a point supports a fundamental matrix [px]", Range{0.1, 100});
    visit("ransac_confidence", self.ransac_confidence, "wanted of RANSAC", Range{0.5, 0.99999});
    visit("ransac_iterations", self.ransac_iterations, "of RANSAC, at most", Range{1, 100000});
    visit("min_points", self.min_points, "fewer points give no verdict", Range{15, 100000});
    visit("min_inlier_share", self.min_inlier_share,
          "of the points; below it the fundamental matrix is not believed", Range{0, 1});
  }
};

struct DynamicsOptions {
  DynamicsMode mode = DynamicsMode::kFull;
  /// Mode `paper`: moving whatever they do. Mode `full`: presumed to, until they stand still.
  std::vector<std::string> dynamic_classes = {"person"};
  std::vector<std::string> always_dynamic = {};  ///< moving whatever they do
  std::vector<std::string> never_dynamic = {};   ///< standing still whatever seems to move
  int dilation_px = 7;                           ///< radius by which masks grow, mode `paper`
  double exclusion_radius_px = 10;               ///< around a point found moving, mode `paper`
  EpipolarOptions epipolar = {};                 ///< of mode `paper`
  double crowded_features = 2;  ///< at most times as many features; from here on: of mode `full`
  MotionOptions motion = {};
  MaskRefinementOptions refinement = {};
  InstanceTrackerOptions tracker = {};
  InstanceMotionOptions instance_motion = {};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("mode", self.mode, "what is culled");
    visit("dynamic_classes", self.dynamic_classes,
          "classes that move: mode paper whatever they do, mode full until they stand still");
    visit("always_dynamic", self.always_dynamic, "classes that move whatever they do");
    visit("never_dynamic", self.never_dynamic, "classes that never move (mode full)");
    visit("dilation_px", self.dilation_px, "radius by which masks grow, mode paper [px]",
          Range{0, 100});
    visit("exclusion_radius_px", self.exclusion_radius_px,
          "radius masked around a point found moving, mode paper [px]", Range{0, 100});
    visit("crowded_features", self.crowded_features,
          "as many features for each visible pixel as where nothing is masked, but at most so many "
          "times as many in all, mode full",
          Range{1, 5});
    visit("epipolar", self.epipolar, "motion by epipolar geometry, mode paper");
    visit("motion", self.motion, "motion by flow and depth, mode full");
    visit("refinement", self.refinement, "instance masks and depth, mode full");
    visit("tracker", self.tracker, "instances over time, mode full");
    visit("instance_motion", self.instance_motion, "which instances move, mode full");
  }
};

}  // namespace ofm
