#include "ofm/loop/loop_matching.h"

#include <algorithm>
#include <map>
#include <set>

#include "ofm/features/matching.h"
#include "ofm/features/orientation_consistency.h"
#include "ofm/loop/static_landmarks.h"
#include "ofm/map/covisibility.h"
#include "ofm/map/projection.h"

namespace ofm {
namespace {

constexpr std::size_t kPlaceNeighbours = 10;

/// Static landmarks of a keyframe by the features that show them.
struct ShownLandmarks {
  std::vector<int> features;
  std::vector<LandmarkId> landmarks;
  std::vector<Descriptor> descriptors;
};

ShownLandmarks FindShown(const MapSnapshot& map, const Keyframe& keyframe, double min_probability) {
  ShownLandmarks shown;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const int feature = static_cast<int>(i);
    const Landmark* landmark = map.FindLandmark(keyframe.landmarks[i]);
    if (landmark == nullptr || !IsStatic(map, keyframe, feature, min_probability)) continue;
    shown.features.push_back(feature);
    shown.landmarks.push_back(landmark->id);
    shown.descriptors.push_back(keyframe.features->descriptors[i]);
  }
  return shown;
}

/// Matches of two keyframes' landmarks whose features turned alike, as indices into both lists.
std::vector<FeatureMatch> MatchShown(const Keyframe& a, const ShownLandmarks& of_a,
                                     const Keyframe& b, const ShownLandmarks& of_b) {
  const MatchOptions options{.max_distance = 50, .max_ratio = 0.75};
  const std::vector<FeatureMatch> matches =
      MatchBruteForce(of_a.descriptors, of_b.descriptors, options);
  std::vector<AnglePair> angles;
  for (const FeatureMatch& match : matches) {
    angles.push_back({a.features->keypoints[of_a.features[match.a]].angle_rad,
                      b.features->keypoints[of_b.features[match.b]].angle_rad});
  }
  const std::vector<bool> keep = ConsistentOrientations(angles);
  std::vector<FeatureMatch> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (keep[i]) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace

std::vector<KeyframeId> KeyframesAbout(const MapSnapshot& map, KeyframeId id) {
  std::vector<KeyframeId> keyframes{id};
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, id)) {
    if (keyframes.size() > kPlaceNeighbours) break;
    keyframes.push_back(neighbour.id);
  }
  return keyframes;
}

std::vector<LandmarkId> LandmarksOf(const MapSnapshot& map,
                                    const std::vector<KeyframeId>& keyframes,
                                    double min_probability) {
  std::set<LandmarkId> landmarks;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId named : map.keyframes.Find(id)->landmarks) {
      const Landmark* landmark = map.FindLandmark(named);
      if (landmark == nullptr || landmark->static_probability < min_probability) continue;
      landmarks.insert(landmark->id);
    }
  }
  return {landmarks.begin(), landmarks.end()};
}

std::vector<LoopMatch> MatchPlace(const MapSnapshot& map, const Keyframe& keyframe,
                                  const std::vector<KeyframeId>& place, double min_probability) {
  struct Best {
    LandmarkId landmark;
    int distance = 0;
  };
  const ShownLandmarks mine = FindShown(map, keyframe, min_probability);
  std::map<int, Best> best_of_feature;
  for (const KeyframeId id : place) {
    const Keyframe& other = *map.keyframes.Find(id);
    const ShownLandmarks theirs = FindShown(map, other, min_probability);
    for (const FeatureMatch& match : MatchShown(keyframe, mine, other, theirs)) {
      const Best found{theirs.landmarks[match.b], match.distance};
      if (found.landmark == mine.landmarks[match.a]) continue;  // no news
      const auto [best, is_new] = best_of_feature.emplace(mine.features[match.a], found);
      if (!is_new && found.distance < best->second.distance) best->second = found;
    }
  }
  std::map<LandmarkId, std::pair<int, int>> best_of_landmark;  // distance, feature
  for (const auto& [feature, best] : best_of_feature) {
    const std::pair found(best.distance, feature);
    const auto [known, is_new] = best_of_landmark.emplace(best.landmark, found);
    if (!is_new) known->second = std::min(known->second, found);
  }
  std::vector<LoopMatch> matches;
  for (const auto& [landmark, best] : best_of_landmark) matches.push_back({best.second, landmark});
  return matches;
}

std::vector<LoopMatch> SearchByProjection(const MeasurementModel& model, const Keyframe& keyframe,
                                          const std::vector<Landmark>& landmarks,
                                          const LoopSearch& search) {
  std::vector<char> taken(keyframe.features->size(), 0);
  std::vector<LoopMatch> matches;
  for (const Landmark& landmark : landmarks) {
    const auto projection =
        ProjectLandmark(model.camera, search.camera_from_world, landmark, model.scales);
    if (!projection) continue;
    FeatureQuery query;
    query.ideal_px = projection->ideal_px.cast<float>();
    query.radius_px = static_cast<float>(search.radius_px) * model.scales.Scale(projection->octave);
    query.min_octave = projection->octave - 1;
    query.max_octave = projection->octave + 1;
    query.descriptor = landmark.descriptor;
    const FeatureCandidate found = FindFeature(*keyframe.features, query, [&](int feature) {
      return !taken[feature] &&
             keyframe.features->StaticProbability(feature) >= search.min_static_probability;
    });
    if (found.feature < 0 || found.distance > search.max_hamming) continue;
    taken[found.feature] = 1;
    matches.push_back({found.feature, landmark.id});
  }
  return matches;
}

}  // namespace ofm
