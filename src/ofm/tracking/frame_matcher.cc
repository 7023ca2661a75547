#include "ofm/tracking/frame_matcher.h"

#include <algorithm>

#include "ofm/features/matching.h"
#include "ofm/features/orientation_consistency.h"
#include "ofm/map/covisibility.h"
#include "ofm/map/projection.h"

namespace ofm {
namespace {

/// A point that the last frame saw in its feature; empty where the feature shows none.
std::optional<PointMatch> PointOfFeature(const MeasurementModel& model, const MapSnapshot& map,
                                         const TrackedFrame& last, int feature) {
  PointMatch point;
  point.feature = feature;
  if (last.landmarks[feature].valid()) {
    const Landmark* landmark = map.FindLandmark(last.landmarks[feature]);
    if (landmark != nullptr) {
      point.landmark = landmark->id;
      point.point_in_world = landmark->position_in_world;
      return point;
    }
  }
  const float depth = last.features->depth_m[feature];
  if (depth <= 0 || depth > model.CloseDepth()) return {};
  point.point_in_world =
      last.camera_from_world.Inverse() * *PointInCamera(*last.features, feature, model.camera);
  return point;
}

/// Drops the matches whose feature turned otherwise than most (see orientation_consistency.h).
void KeepConsistentTurns(const TrackedFrame& last, const FrameFeatures& frame,
                         const std::vector<int>& last_features, std::vector<PointMatch>& matches) {
  std::vector<AnglePair> angles;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    angles.push_back({last.features->keypoints[last_features[i]].angle_rad,
                      frame.keypoints[matches[i].feature].angle_rad});
  }
  const std::vector<bool> keep = ConsistentOrientations(angles);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (keep[i]) matches[kept++] = matches[i];
  }
  matches.resize(kept);
}

/// Keyframes whose landmarks make up the local map, the one that shares most with the frame first.
std::vector<KeyframeId> LocalKeyframes(const TrackingOptions& options, const MapSnapshot& map,
                                       std::span<const PointMatch> known, KeyframeId near) {
  constexpr int kNeighboursOf = 3, kNeighbours = 10;
  std::vector<LandmarkId> landmarks;
  for (const PointMatch& match : known) landmarks.push_back(match.landmark);
  const std::vector<CovisibleKeyframe> observers = CountObservers(map, landmarks);
  std::vector<KeyframeId> result;
  const std::size_t limit = options.max_local_keyframes;
  const auto add = [&](KeyframeId id) {
    if (result.size() < limit && map.keyframes.Find(id) != nullptr &&
        std::find(result.begin(), result.end(), id) == result.end()) {
      result.push_back(id);
    }
  };
  for (const CovisibleKeyframe& observer : observers) add(observer.id);
  if (observers.empty()) add(near);
  const std::size_t seeds = std::min<std::size_t>(kNeighboursOf, result.size());
  for (std::size_t i = 0; i < seeds; ++i) {
    const std::vector<CovisibleKeyframe> neighbours = FindCovisible(map, result[i]);
    for (std::size_t n = 0; n < std::min<std::size_t>(kNeighbours, neighbours.size()); ++n) {
      add(neighbours[n].id);
    }
  }
  return result;
}

float LocalMapRadius(double view_cosine, const TrackingOptions& options) {
  return static_cast<float>(options.map_radius_px * (view_cosine > 0.998 ? 2.5 : 4.0));
}

}  // namespace

std::vector<PointMatch> MatchLastFrame(const MeasurementModel& model,
                                       const TrackingOptions& options, const MapSnapshot& map,
                                       const TrackedFrame& last, const FrameView& view,
                                       double radius_px) {
  std::vector<char> taken(view.features.size(), 0);
  std::vector<char> found_before(map.replacements.size(), 0);  // two names may have become one
  std::vector<PointMatch> matches;
  std::vector<int> last_features;
  for (std::size_t i = 0; i < last.features->size(); ++i) {
    std::optional<PointMatch> point = PointOfFeature(model, map, last, static_cast<int>(i));
    if (!point) continue;
    if (point->landmark.valid() && found_before[point->landmark.value]) continue;
    const Eigen::Vector3d in_camera = view.camera_from_world * point->point_in_world;
    if (in_camera.z() <= 0.05) continue;
    const Eigen::Vector2d ideal = model.camera.ProjectIdeal(in_camera);
    if (!model.camera.IsInImage(ideal)) continue;
    const int octave = last.features->keypoints[i].octave;
    FeatureQuery query;
    query.ideal_px = ideal.cast<float>();
    query.radius_px = static_cast<float>(radius_px) * model.scales.Scale(octave);
    query.min_octave = octave - 1;
    query.max_octave = octave + 1;
    query.descriptor = last.features->descriptors[i];
    const FeatureCandidate found =
        FindFeature(view.features, query, [&](int feature) { return !taken[feature]; });
    if (found.feature < 0 || found.distance > options.max_hamming) continue;
    if (found.distance > options.ratio * found.second_distance) continue;
    taken[found.feature] = 1;
    if (point->landmark.valid()) found_before[point->landmark.value] = 1;
    point->feature = found.feature;
    matches.push_back(*point);
    last_features.push_back(static_cast<int>(i));
  }
  KeepConsistentTurns(last, view.features, last_features, matches);
  return matches;
}

LocalMapMatches MatchLocalMap(const MeasurementModel& model, const TrackingOptions& options,
                              const MapSnapshot& map, const FrameView& view,
                              std::span<const PointMatch> known) {
  LocalMapMatches result;
  const std::vector<KeyframeId> keyframes = LocalKeyframes(options, map, known, view.near);
  if (!keyframes.empty()) result.reference = keyframes.front();
  std::vector<char> seen(map.replacements.size(), 0);
  std::vector<char> taken(view.features.size(), 0);
  for (const PointMatch& match : known) {
    taken[match.feature] = 1;
    if (match.landmark.valid()) seen[match.landmark.value] = 1;
  }
  for (const KeyframeId keyframe : keyframes) {
    for (const LandmarkId id : map.keyframes.Find(keyframe)->landmarks) {
      if (!id.valid() || seen[id.value]) continue;
      seen[id.value] = 1;
      const Landmark* landmark = map.landmarks.Find(id);
      if (landmark == nullptr) continue;
      const auto projection =
          ProjectLandmark(model.camera, view.camera_from_world, *landmark, model.scales);
      if (!projection) continue;
      result.visible.push_back(id);
      FeatureQuery query;
      query.ideal_px = projection->ideal_px.cast<float>();
      query.radius_px =
          LocalMapRadius(projection->view_cosine, options) * model.scales.Scale(projection->octave);
      query.min_octave = projection->octave - 1;
      query.max_octave = projection->octave;
      query.descriptor = landmark->descriptor;
      const FeatureCandidate found =
          FindFeature(view.features, query, [&](int feature) { return !taken[feature]; });
      if (found.feature < 0 || found.distance > options.max_hamming) continue;
      if (found.second_same_octave && found.distance > options.map_ratio * found.second_distance) {
        continue;
      }
      taken[found.feature] = 1;
      result.matches.push_back({found.feature, id, landmark->position_in_world});
    }
  }
  return result;
}

std::vector<PointMatch> MatchKeyframe(const TrackingOptions& options, const MapSnapshot& map,
                                      const Keyframe& keyframe, const FrameFeatures& frame) {
  std::vector<const Landmark*> landmarks;
  std::vector<Descriptor> descriptors;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const Landmark* landmark = map.FindLandmark(keyframe.landmarks[i]);
    if (landmark == nullptr) continue;
    landmarks.push_back(landmark);
    descriptors.push_back(keyframe.features->descriptors[i]);
  }
  MatchOptions match_options;
  match_options.max_distance = options.max_hamming / 2 + 10;
  match_options.max_ratio = 0.8;
  std::vector<PointMatch> matches;
  for (const FeatureMatch& match : MatchBruteForce(descriptors, frame.descriptors, match_options)) {
    const Landmark& landmark = *landmarks[match.a];
    matches.push_back({match.b, landmark.id, landmark.position_in_world});
  }
  return matches;
}

}  // namespace ofm
