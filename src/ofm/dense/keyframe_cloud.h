// A key frame as a small labelled cloud.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "ofm/base/time.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/dense_options.h"
#include "ofm/dense/labelled_frame.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/dense/semantic_octree.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// A set of the frames that a key frame's cloud is made of: a bit per frame.
using FrameBits = std::uint32_t;

/// From the first to the last time that something was seen; empty where it never was.
struct SeenSpan {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();

  double Seconds() const {
    return first_ns > last_ns ? 0 : NanosecondsToSeconds(last_ns - first_ns);
  }
  /// The least span that holds both.
  SeenSpan Joined(const SeenSpan& other) const {
    return {std::min(first_ns, other.first_ns), std::max(last_ns, other.last_ns)};
  }
};

/// A place where something that moves was seen.
struct MoverPoint {
  Eigen::Vector3f position;  ///< [m]
  FrameBits seen_in = 0;
};

/// What a key frame gives to the map, in its camera's frame: it stays good whatever becomes of the
/// key frame's pose.
struct KeyframeCloud {
  std::vector<LabelledPoint> points_in_camera;
  /// Ends, at the range limit, of the rays to points beyond it: they free and fill nothing [m].
  std::vector<Eigen::Vector3f> free_ends_in_camera;
  /// When the frames were taken, by their bits; the key frame is the first.
  std::vector<std::int64_t> stamps_ns = {};
  /// One per voxel of kMoverVoxel_m, for passing_voxels.h.
  std::vector<MoverPoint> movers_in_camera = {};
  std::vector<FrameBits> seen_in = {};  ///< of each point
  /// Of each point, not 0 where a frame showed it off its border (PassingOptions::border_share), or
  /// one without masks anywhere.
  std::vector<std::uint8_t> off_border = {};

  static constexpr double kMoverVoxel_m = .05;

  SeenSpan SpanOf(FrameBits frames) const;
};

/// By key frame; shared, so that other threads can read them.
using KeyframeClouds = std::map<KeyframeId, std::shared_ptr<const KeyframeCloud>>;

/// world_from_camera of key frames.
using KeyframePoseMap = std::map<KeyframeId, RigidTransform>;

/// A key frame's cloud where `world_from_camera` puts it.
WorldScan TransformToWorld(const KeyframeCloud& cloud, const RigidTransform& world_from_camera);

/// Makes clouds for one camera. The range is the distance from the camera, not z.
class KeyframeCloudMaker {
 public:
  /// Throws Error where an option is out of its range.
  KeyframeCloudMaker(const PinholeCamera& camera, const DenseOptions& options);

  /// Back-projects the usable pixels (usable_pixels.h), lens distortion undone, and keeps one point
  /// per voxel of CloudResolution(). `views` are frames from nearby, for what the key frame does
  /// not show.
  KeyframeCloud Make(const LabelledFrame& keyframe,
                     std::span<const LabelledFrame> views = {}) const;

 private:
  struct Gathered;
  void Gather(const LabelledFrame& frame, FrameBits bit, Gathered& gathered) const;
  void GatherMovers(const LabelledFrame& frame, FrameBits bit, Gathered& gathered) const;

  PinholeCamera camera_;
  DenseOptions options_;
  std::vector<Eigen::Vector2f> rays_;  // (x, y) of the point at z = 1 m behind each pixel
};

}  // namespace ofm
