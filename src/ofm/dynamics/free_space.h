// What stands where an earlier view looked through must have moved there.
#pragma once

#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dynamics/motion_options.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// Depth as it was seen from a known place. A value: its images are never written again.
struct DepthView {
  std::int64_t stamp_ns = 0;
  RigidTransform camera_from_start;  ///< at the time of the depth image
  cv::Mat depth_m;                   ///< CV_32FC1 per cell, 0 = not measured
  cv::Mat least_depth_m;             ///< the nearest of the cells around; 0 where one has no depth
};

/// Adds what `least_depth_m` needs.
DepthView MakeDepthView(std::int64_t stamp_ns, const RigidTransform& camera_from_start,
                        const cv::Mat& depth_m);

/// Views of the last seconds, some time apart: copies are cheap.
class DepthMemory {
 public:
  /// Keeps `view` where the last one is older than the interval, and forgets what is too old.
  void Add(const DepthView& view, const FreeSpaceOptions& options);
  /// The views nearest to 1, 2, 4, … intervals before `stamp_ns`, each once.
  std::vector<const DepthView*> Select(std::int64_t stamp_ns,
                                       const FreeSpaceOptions& options) const;
  std::size_t size() const { return views_.size(); }

 private:
  std::deque<DepthView> views_;  // by increasing time
};

/// Log-odds of moving per cell of `current` (CV_32FC1): options.log_odds where at least one of
/// `earlier` looked through the place where the cell's surface is now; else options.static_log_odds
/// for each that saw a surface there (DynaSLAM's multi-view test turned round, Bescos et al. 2018,
/// section III-C). What was hidden or out of sight says nothing.
cv::Mat FreeSpaceEvidence(const PinholeCamera& lattice_camera, const DepthView& current,
                          const std::vector<const DepthView*>& earlier,
                          const FreeSpaceOptions& options);

}  // namespace ofm
