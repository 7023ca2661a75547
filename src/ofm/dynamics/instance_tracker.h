// Who is who over time, and where those are that the network missed.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ofm/base/options.h"
#include "ofm/dynamics/box_filter.h"
#include "ofm/perception/depth_range.h"
#include "ofm/perception/segmentation.h"

namespace ofm {

struct InstanceTrackerOptions {
  BoxFilterOptions filter = {};
  double max_missed_s = 0.4;       ///< a track is bridged for so long
  int min_hits = 2;                ///< detections that a track needs to be bridged
  double birth_score = 0.5;        ///< under it a detection only continues a track
  double iou_weight = 1;           ///< of 1 − overlap with the predicted box
  double centre_weight = 1;        ///< of the distance of the centres / the box's diagonal
  double depth_weight = 0.5;       ///< of the difference in depth [1/m]
  double max_cost = 1.8;           ///< a dearer pair is no match
  double depth_margin_m = 0.33;    ///< around the object's depths, in a bridged mask
  double score_decay_per_s = 0.5;  ///< share of the score that a second without detection leaves

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("filter", self.filter, "Kalman filter of the boxes");
    visit("max_missed_s", self.max_missed_s, "a track is bridged for so long [s]", Range{0, 100});
    visit("min_hits", self.min_hits, "detections that a track needs to be bridged", Range{1, 1000});
    visit("birth_score", self.birth_score, "under this score a detection only continues a track",
          Range{0, 1});
    visit("iou_weight", self.iou_weight, "of 1 - overlap with the predicted box", Range{0, 100});
    visit("centre_weight", self.centre_weight, "of the centres' distance / the box's diagonal",
          Range{0, 100});
    visit("depth_weight", self.depth_weight, "of the difference in depth [1/m]", Range{0, 100});
    visit("max_cost", self.max_cost, "a dearer pair is no match", Range{0, 1000});
    visit("depth_margin_m", self.depth_margin_m,
          "around the object's depths, in a bridged mask [m]", Range{0, 100});
    visit("score_decay_per_s", self.score_decay_per_s,
          "share of the score that a second without detection leaves", Range{0, 1});
  }
};

/// An object over time.
struct InstanceTrack {
  Instance instance;    ///< now; its id is the track's and never changes
  BoxState state;       ///< of box and depth, now
  int hits = 0;         ///< detections so far
  double missed_s = 0;  ///< since the last detection; 0 = detected now

  /// As it was last detected: what bridges start from.
  struct Seen {
    cv::Mat mask;
    float score = 0;
    Eigen::Vector2d centre_px = {0, 0};  ///< of the filter
    std::optional<DepthRange> depths;    ///< relative to the filter's depth; empty = not measured
  } seen = {};
};

/// What is believed of all objects at one time. A value.
struct InstanceTracks {
  std::int64_t stamp_ns = 0;
  std::uint32_t next_id = 0;
  std::vector<InstanceTrack> tracks;  ///< by increasing id
};

/// What is seen at a time.
struct InstanceObservation {
  const std::vector<Instance>& instances;
  const cv::Mat& depth_m;  ///< CV_32FC1 [m] of the masks' size, 0 = not measured
  std::int64_t stamp_ns = 0;
};

/// The tracks after an observation: a pure function. Detections are matched with the predicted
/// boxes of tracks of their class (Hungarian method on overlap, distance and depth); the others
/// begin tracks where their score is at least birth_score (as in Zhang et al., "ByteTrack", 2022: a
/// doubtful detection of what is known is worth having, one of something new is not). A track that
/// is missed keeps its mask, moved as the filter predicts and trimmed to the predicted depth, until
/// max_missed_s have passed or it has left the image. Observations come in increasing order of
/// time. After Hu et al., "CFP-SLAM", 2022, section III-B.
InstanceTracks TrackInstances(const InstanceTracks& before, const InstanceObservation& now,
                              const InstanceTrackerOptions& options);

}  // namespace ofm
