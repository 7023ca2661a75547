// Carries the instances of one frame to later ones.
#pragma once

#include <optional>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/camera/ideal_lattice.h"
#include "ofm/perception/depth_range.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

struct MaskPropagationOptions {
  double depth_margin_m = 0.33;  ///< of the object's depths; what is farther off is not object
  int growth_px = 16;            ///< how far it grows along the object's surface
  double growth_step_m = 0.08;   ///< between neighbouring cells on it
  double growth_budget = 1.05;   ///< it stops at this share of the area before trimming
  double min_part_share = 0.1;   ///< of the largest part; smaller parts are dropped
  int max_hole_px = 400;         ///< pixels of the holes that are closed

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("depth_margin_m", self.depth_margin_m,
          "what is farther than this from the object's depths is trimmed [m]", Range{0, 100});
    visit("growth_px", self.growth_px, "how far a mask grows along the object's surface [px]",
          Range{0, 1000});
    visit("growth_step_m", self.growth_step_m, "depth step between cells on one surface [m]",
          Range{0, 10});
    visit("growth_budget", self.growth_budget,
          "growth stops at this share of the area before trimming", Range{0, 10});
    visit("min_part_share", self.min_part_share, "of the largest part; smaller ones are dropped",
          Range{0, 1});
    visit("max_hole_px", self.max_hole_px, "pixels of the holes that are closed", Range{0, 1e6});
  }
};

/// Instances as the network saw them, made ready for carrying. A value.
struct MaskSource {
  std::vector<Instance> instances;
  std::vector<cv::Mat> cells;  ///< their masks as CV_8UC1 per cell: 255 = all of it is object
  std::vector<std::optional<DepthRange>> depths;  ///< that they had; empty = not measured
};

/// The frame that masks are carried to.
struct MaskTarget {
  const cv::Mat& origins;       ///< of its cells in the source's frame (CarryOrigins)
  const cv::Mat& cell_depth_m;  ///< CV_32FC1 [m] per cell, 0 = not known
  const cv::Mat& depth_m;       ///< CV_32FC1 [m] of the image's size, 0 = not measured
  double age_s = 0;             ///< of the source
};

/// Masks follow the dense flow of the lattice: an object is where its cells came from its mask.
/// That is trimmed to depths that it can have come to, and that most of it has, grown along its
/// surface, also to where flow knows no origin (what comes into view), freed of small parts and
/// holes, and ends in the image where the object's depth ends. Immutable.
class MaskPropagation {
 public:
  MaskPropagation(const IdealLattice& cells, const MaskPropagationOptions& options);

  /// The masks have the size of the camera's image; `cell_depth_m` is that of their frame.
  MaskSource Prepare(std::vector<Instance> instances, const cv::Mat& cell_depth_m) const;

  /// The instances as they are in another frame, in their order; those that are no longer to be
  /// seen are missing. A pure function.
  std::vector<Instance> Carry(const MaskSource& source, const MaskTarget& target) const;

 private:
  std::optional<DepthRange> FindDepths(const cv::Mat& mask, const cv::Mat& depth_m) const;
  /// Trims and grows what flow made of a mask, per cell; `free`: where it grows however far.
  void FitToDepth(const cv::Mat& depth_m, const cv::Mat& free, cv::Mat& mask) const;
  /// Drops small parts, closes holes. False where too little is left.
  bool Tidy(cv::Mat& mask) const;
  int InCells(int pixels) const { return pixels / cells_.spacing_px(); }

  IdealLattice cells_;
  MaskPropagationOptions options_;
  cv::Mat seen_;  // CV_8UC1 per cell, 255 where the camera sees it
};

}  // namespace ofm
