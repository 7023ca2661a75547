// Carries the instances of one frame to another.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/perception/displacement_field.h"
#include "ofm/perception/flow_frame.h"
#include "ofm/perception/mask_points.h"
#include "ofm/perception/optical_flow.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

struct MaskPropagationOptions {
  MaskPointOptions points = {};
  DisplacementOptions displacement = {};
  int search_px = 96;            ///< reach of the coarse search that flow starts from
  double depth_margin_m = 0.33;  ///< of the object's depths; what is farther off is not object
  double max_departure_px = 24;  ///< a point that flow takes farther from the coarse search is lost
  int growth_px = 16;            ///< how far it grows along the object's surface
  double growth_step_m = 0.05;   ///< between neighbouring pixels on it
  double growth_budget = 1.05;   ///< it stops at this share of the area before trimming
  double min_part_share = 0.1;   ///< of the largest part; smaller parts are dropped
  int max_hole_px = 400;         ///< pixels of the holes that are closed
  double max_lost_s = 0.5;       ///< without flow an object goes on as it went for so long

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("points", self.points, "points followed on an object");
    visit("displacement", self.displacement, "the object's motion from its points");
    visit("search_px", self.search_px, "reach of the coarse search that flow starts from [px]",
          Range{0, 1000});
    visit("depth_margin_m", self.depth_margin_m,
          "what is farther than this from the object's depths is trimmed [m]", Range{0, 100});
    visit("max_departure_px", self.max_departure_px,
          "a point that flow takes farther than this from the coarse search is lost [px]",
          Range{1, 1000});
    visit("growth_px", self.growth_px, "how far a mask grows along the object's surface [px]",
          Range{0, 1000});
    visit("growth_budget", self.growth_budget,
          "growth stops at this share of the area before trimming", Range{0, 10});
    visit("growth_step_m", self.growth_step_m, "depth step between pixels on one surface [m]",
          Range{0, 10});
    visit("min_part_share", self.min_part_share, "of the largest part; smaller ones are dropped",
          Range{0, 1});
    visit("max_hole_px", self.max_hole_px, "pixels of the holes that are closed", Range{0, 1e6});
    visit("max_lost_s", self.max_lost_s,
          "without flow an object goes on as it went for so long [s]", Range{0, 100});
  }
};

/// An instance on its way through the frames.
struct CarriedInstance {
  Instance instance;
  Eigen::Vector2f velocity_px_s = {0, 0};  ///< of its last carriage by flow
  double lost_s = 0;                       ///< since then
};

/// The instances of the frame from, as they are in the frame to, in their order; those that have
/// left the image, or whose flow was lost for longer than max_lost_s, are missing. Points on the
/// object are followed by Lucas–Kanade from a coarse search; the mask is warped by the motion that
/// most of them agree on and their departures from it (at half the resolution), trimmed to the
/// depths of these points, freed of small parts and holes. Where a mask touches the image's border
/// it goes on beyond. A pure function. After Ma et al., "NGD-SLAM: Towards Real-Time Dynamic SLAM
/// without GPU", 2024, section III-B.
std::vector<CarriedInstance> CarryInstances(std::span<const CarriedInstance> instances,
                                            const FlowFrame& from, const FlowFrame& to,
                                            const MaskPropagationOptions& options,
                                            const OpticalFlowOptions& flow_options);

}  // namespace ofm
