#include "ofm/objects/track_log.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "ofm/base/median.h"
#include "ofm/base/time.h"

namespace ofm {
namespace {

/// Fills in the speeds of a track.
void MeasureSpeeds(std::vector<TrackPoint>& points, double window_s) {
  const std::int64_t half_ns = SecondsToNanoseconds(window_s / 2);
  std::size_t first = 0, last = 0;
  for (TrackPoint& point : points) {
    while (points[first].stamp_ns < point.stamp_ns - half_ns) ++first;
    while (last + 1 < points.size() && points[last + 1].stamp_ns <= point.stamp_ns + half_ns)
      ++last;
    const TrackPoint &from = points[first], &to = points[last];
    const double elapsed_s = NanosecondsToSeconds(to.stamp_ns - from.stamp_ns);
    if (elapsed_s <= 0) continue;
    point.speed_m_s = (to.position_in_world - from.position_in_world).norm() / elapsed_s;
  }
}

/// The pose of just this frame; null where it has none.
const RigidTransform* FindPose(const Trajectory& trajectory, std::int64_t stamp_ns) {
  const auto pose = std::ranges::lower_bound(trajectory, stamp_ns, {}, &StampedPose::stamp_ns);
  if (pose == trajectory.end() || pose->stamp_ns != stamp_ns) return nullptr;
  return &pose->world_from_camera;
}

}  // namespace

std::optional<Eigen::Vector3d> MedianPoint(const cv::Mat& mask, const cv::Mat& depth_m,
                                           const PinholeCamera& camera) {
  constexpr int kStep_px = 4;
  constexpr std::size_t kMinPoints = 20;
  std::array<std::vector<double>, 3> coordinates;
  const cv::Rect box = cv::boundingRect(mask);
  for (int row = box.y; row < box.y + box.height; row += kStep_px) {
    for (int column = box.x; column < box.x + box.width; column += kStep_px) {
      const float depth = depth_m.at<float>(row, column);
      if (mask.at<std::uint8_t>(row, column) == 0 || !(depth > 0)) continue;
      const Eigen::Vector3d point =
          camera.UnprojectIdeal(camera.Undistort(Eigen::Vector2d(column, row)), depth);
      for (int axis = 0; axis < 3; ++axis) coordinates[axis].push_back(point[axis]);
    }
  }
  if (coordinates[0].size() < kMinPoints) return {};
  return Eigen::Vector3d(UpperMedian(std::move(coordinates[0])),
                         UpperMedian(std::move(coordinates[1])),
                         UpperMedian(std::move(coordinates[2])));
}

void TrackLog::Add(std::int64_t stamp_ns, const cv::Mat& depth_m,
                   const std::vector<FollowedInstance>& instances) {
  for (const FollowedInstance& followed : instances) {
    const auto place = MedianPoint(followed.mask, depth_m, camera_);
    if (!place) continue;
    samples_[followed.id].push_back({stamp_ns, followed.class_id, followed.score, *place});
  }
}

std::vector<ObjectTrack> TrackLog::Build(const Trajectory& trajectory) const {
  std::vector<ObjectTrack> tracks;
  for (const auto& [id, samples] : samples_) {
    ObjectTrack track{id, samples.front().class_id, 0, {}};
    for (const Sample& sample : samples) {
      const RigidTransform* pose = FindPose(trajectory, sample.stamp_ns);
      if (pose == nullptr) continue;
      track.points.push_back({sample.stamp_ns, *pose * sample.position_in_camera, 0});
      track.score += sample.score;
    }
    if (track.points.empty()) continue;
    const std::int64_t lasted_ns = track.points.back().stamp_ns - track.points.front().stamp_ns;
    if (NanosecondsToSeconds(lasted_ns) < options_.min_duration_s) continue;
    track.score /= static_cast<double>(track.points.size());
    MeasureSpeeds(track.points, options_.speed_window_s);
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace ofm
