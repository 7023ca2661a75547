#include "ofm/dynamics/instance_tracker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "ofm/base/check.h"
#include "ofm/base/median.h"
#include "ofm/base/time.h"
#include "ofm/dynamics/assignment.h"
#include "ofm/perception/depth_range.h"
#include "ofm/perception/mask_parts.h"

namespace ofm {
namespace {

/// A detection with what is measured of it.
struct Detection {
  const Instance* instance = nullptr;
  BoxMeasurement measurement;
  std::optional<DepthRange> depths;
};

Detection Measure(const Instance& instance, const cv::Mat& depth_m, double margin_m) {
  OFM_CHECK(instance.mask.type() == CV_8UC1 && instance.mask.size() == depth_m.size());
  constexpr std::size_t kLeast = 10;
  Detection detection{&instance, {instance.box, {}}, {}};
  constexpr int kStep = 4;
  const cv::Rect box = instance.box & cv::Rect({}, depth_m.size());
  std::vector<float> depths = SampleDepths(instance.mask(box), depth_m(box), kStep);
  std::erase(depths, 0.0F);
  if (depths.size() < kLeast) return detection;
  detection.measurement.depth_m = UpperMedian(depths);
  detection.depths = FindDepthRange(std::move(depths), margin_m, kLeast);
  return detection;
}

double Cost(const InstanceTrack& track, const Detection& detection,
            const InstanceTrackerOptions& options) {
  if (track.instance.class_id != detection.instance->class_id) return kForbiddenCost;
  const cv::Rect2d predicted = track.state.Box(), seen(detection.measurement.box);
  const double both = (predicted & seen).area();
  const double overlap = both / (predicted.area() + seen.area() - both);
  const Eigen::Vector2d centre(seen.x + seen.width / 2, seen.y + seen.height / 2);
  const double diagonal =
      std::max(std::hypot(predicted.width, predicted.height), std::hypot(seen.width, seen.height));
  double cost = options.iou_weight * (1 - overlap) +
                options.centre_weight * (centre - track.state.centre_px()).norm() / diagonal;
  if (detection.measurement.depth_m && track.seen.depths) {
    cost += options.depth_weight * std::abs(*detection.measurement.depth_m - track.state.depth_m());
  }
  return cost <= options.max_cost ? cost : kForbiddenCost;
}

/// The mask moved by whole pixels; what comes in is empty.
cv::Mat Shifted(const cv::Mat& mask, cv::Point shift) {
  cv::Mat moved(mask.size(), CV_8UC1, cv::Scalar(0));
  const cv::Rect image({}, mask.size());
  const cv::Rect to = (image + shift) & image;
  if (!to.empty()) mask(to - shift).copyTo(moved(to));
  return moved;
}

/// Moves the mask as predicted. False where nothing of it is left.
bool Bridge(const cv::Mat& depth_m, InstanceTrack& track) {
  const Eigen::Vector2d shift = track.state.centre_px() - track.seen.centre_px;
  if (!(shift.norm() < depth_m.cols + depth_m.rows)) return false;
  cv::Mat mask = Shifted(track.seen.mask, {static_cast<int>(std::lround(shift.x())),
                                           static_cast<int>(std::lround(shift.y()))});
  if (track.seen.depths) {
    const auto depth = static_cast<float>(track.state.depth_m());
    const cv::Rect box = cv::boundingRect(mask);
    cv::Mat object = mask(box);
    TrimToDepth(depth_m(box), {depth + track.seen.depths->near_m, depth + track.seen.depths->far_m},
                object);
  }
  constexpr double kMinPartShare = 0.1;
  constexpr int kMinArea = 64;
  cv::Mat object = mask(cv::boundingRect(mask));
  if (object.empty() || KeepLargestParts(kMinPartShare, object) < kMinArea) return false;
  track.instance.box = cv::boundingRect(mask);
  track.instance.mask = std::move(mask);
  return true;
}

void Detect(const Detection& detection, InstanceTrack& track) {
  const InstanceId id = track.instance.id;
  track.instance = *detection.instance;
  track.instance.id = id;
  ++track.hits;
  track.missed_s = 0;
  track.seen.mask = track.instance.mask;
  track.seen.score = track.instance.score;
  track.seen.centre_px = track.state.centre_px();
  track.seen.depths = detection.depths;
  if (track.seen.depths) {
    const auto depth = static_cast<float>(track.state.depth_m());
    track.seen.depths->near_m -= depth;
    track.seen.depths->far_m -= depth;
  }
}

/// The column of each track's detection, or -1.
std::vector<int> Match(const std::vector<InstanceTrack>& tracks,
                       const std::vector<Detection>& detections,
                       const InstanceTrackerOptions& options) {
  Eigen::MatrixXd cost(tracks.size(), detections.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (std::size_t j = 0; j < detections.size(); ++j) {
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          Cost(tracks[i], detections[j], options);
    }
  }
  return SolveAssignment(cost);
}

/// False where the track ends.
bool Miss(const cv::Mat& depth_m, double interval_s, const InstanceTrackerOptions& options,
          InstanceTrack& track) {
  track.missed_s += interval_s;
  if (track.hits < options.min_hits || track.missed_s > options.max_missed_s) return false;
  track.instance.score =
      track.seen.score * static_cast<float>(std::pow(options.score_decay_per_s, track.missed_s));
  return Bridge(depth_m, track);
}

}  // namespace

InstanceTracks TrackInstances(const InstanceTracks& before, const InstanceObservation& now,
                              const InstanceTrackerOptions& options) {
  OFM_CHECK(now.depth_m.type() == CV_32FC1);
  OFM_CHECK(before.tracks.empty() || now.stamp_ns >= before.stamp_ns);
  const double interval_s =
      before.tracks.empty() ? 0 : NanosecondsToSeconds(now.stamp_ns - before.stamp_ns);
  std::vector<Detection> detections;
  for (const Instance& instance : now.instances) {
    if (!instance.box.empty()) {
      detections.push_back(Measure(instance, now.depth_m, options.depth_margin_m));
    }
  }
  std::vector<InstanceTrack> tracks = before.tracks;
  for (InstanceTrack& track : tracks) {
    track.state = PredictBox(track.state, interval_s, options.filter);
  }
  const std::vector<int> detection_of = Match(tracks, detections, options);
  InstanceTracks after{now.stamp_ns, before.next_id, {}};
  std::vector<char> taken(detections.size(), 0);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    InstanceTrack& track = tracks[i];
    if (detection_of[i] >= 0) {
      const Detection& detection = detections[static_cast<std::size_t>(detection_of[i])];
      taken[static_cast<std::size_t>(detection_of[i])] = 1;
      track.state = UpdateBox(track.state, detection.measurement, options.filter);
      Detect(detection, track);
    } else if (!Miss(now.depth_m, interval_s, options, track)) {
      continue;
    }
    after.tracks.push_back(std::move(track));
  }
  for (std::size_t j = 0; j < detections.size(); ++j) {
    if (taken[j] != 0 || detections[j].instance->score < options.birth_score) continue;
    InstanceTrack track;
    track.instance.id = InstanceId(after.next_id++);
    track.state = StartBox(detections[j].measurement, options.filter);
    Detect(detections[j], track);
    after.tracks.push_back(std::move(track));
  }
  return after;
}

}  // namespace ofm
