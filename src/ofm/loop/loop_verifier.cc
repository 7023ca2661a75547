#include "ofm/loop/loop_verifier.h"

#include "ofm/estimation/point_pair_alignment.h"
#include "ofm/estimation/pose_optimizer.h"
#include "ofm/estimation/reprojection.h"

namespace ofm {
namespace {

/// Of the guided search at octave 0 [px, bits].
constexpr double kRadiusPx = 8;
constexpr int kMaxHamming = 64;

/// How the place's keyframe sees a landmark; where only a neighbour does, how it should.
std::optional<PointObservation> SeenFrom(const Keyframe& place, const Landmark& landmark,
                                         const MeasurementModel& model) {
  const int feature = landmark.FeatureIn(place.id);
  if (feature >= 0) return model.Observe(*place.features, feature);
  const Eigen::Vector3d point = place.camera_from_world * landmark.position_in_world;
  if (!IsBeforeCamera(point)) return {};
  PointObservation seen;
  seen.ideal_px = model.camera.ProjectIdeal(point);
  seen.pixel_sigma =
      model.options.pixel_sigma * model.scales.Scale(model.scales.PredictOctave(
                                      landmark.max_distance_m, static_cast<float>(point.norm())));
  return seen;
}

/// Both ends of the matches, in the cameras of the place and of the keyframe.
std::vector<PointPair> MakePairs(const MapSnapshot& map, const Keyframe& keyframe,
                                 const Keyframe& place, const MeasurementModel& model,
                                 const std::vector<LoopMatch>& matches) {
  std::vector<PointPair> pairs;
  for (const LoopMatch& match : matches) {
    const Landmark& theirs = *map.landmarks.Find(match.landmark);
    const Landmark& mine = *map.FindLandmark(keyframe.landmarks[match.feature]);
    const auto seen_in_place = SeenFrom(place, theirs, model);
    if (!seen_in_place) continue;
    PointPair pair;
    pair.point_in_source = place.camera_from_world * theirs.position_in_world;
    pair.point_in_target = keyframe.camera_from_world * mine.position_in_world;
    pair.seen_in_source = *seen_in_place;
    pair.seen_in_target = model.Observe(*keyframe.features, match.feature);
    pairs.push_back(pair);
  }
  return pairs;
}

/// The landmarks about the place that the keyframe shows, and its pose by them.
VerifiedLoop FindAround(const MapSnapshot& map, const Keyframe& keyframe,
                        const std::vector<Landmark>& landmarks, const LoopSearch& search,
                        const MeasurementModel& model) {
  const std::vector<LoopMatch> matches = SearchByProjection(model, keyframe, landmarks, search);
  std::vector<PoseObservation> observations;
  for (const LoopMatch& match : matches) {
    observations.push_back({map.landmarks.Find(match.landmark)->position_in_world,
                            model.Observe(*keyframe.features, match.feature)});
  }
  const PoseEstimate pose = OptimizePose(model.camera, search.camera_from_world, observations, {});
  VerifiedLoop loop;
  loop.keyframe = keyframe.id;
  loop.camera_from_world = pose.camera_from_world;
  for (std::size_t i = 0; i < matches.size() && pose.converged; ++i) {
    if (pose.inlier[i]) loop.matches.push_back(matches[i]);
  }
  return loop;
}

}  // namespace

LoopVerification VerifyLoop(const MapSnapshot& map, KeyframeId keyframe_id, KeyframeId place_id,
                            const MeasurementModel& model, const LoopOptions& options,
                            RandomEngine& engine) {
  const Keyframe& keyframe = *map.keyframes.Find(keyframe_id);
  const Keyframe& place = *map.keyframes.Find(place_id);
  const std::vector<KeyframeId> about = KeyframesAbout(map, place_id);
  const double min_probability = options.min_static_probability;
  const std::vector<PointPair> pairs =
      MakePairs(map, keyframe, place, model, MatchPlace(map, keyframe, about, min_probability));
  if (static_cast<int>(pairs.size()) < options.min_matches) return {LoopVerdict::kFewMatches, {}};
  const auto alignment =
      AlignPairsRansac(model.camera, pairs, options.min_alignment_inliers, options.ransac, engine);
  if (!alignment) return {LoopVerdict::kNoAlignment, {}};

  std::vector<Landmark> landmarks;
  for (const LandmarkId id : LandmarksOf(map, about, min_probability)) {
    const Landmark& landmark = *map.landmarks.Find(id);
    if (landmark.FeatureIn(keyframe_id) < 0) landmarks.push_back(landmark);
  }
  // Twice: the first pose comes from few matches, and its search misses what is far from them.
  LoopSearch search{alignment->target_from_source * place.camera_from_world, kRadiusPx, kMaxHamming,
                    min_probability};
  search.camera_from_world = FindAround(map, keyframe, landmarks, search, model).camera_from_world;
  VerifiedLoop loop = FindAround(map, keyframe, landmarks, search, model);
  loop.place = place_id;
  loop.place_from_keyframe = place.camera_from_world * loop.camera_from_world.Inverse();
  if (static_cast<int>(loop.matches.size()) < options.min_inliers) {
    return {LoopVerdict::kFewInliers, {}};
  }
  return {LoopVerdict::kVerified, std::move(loop)};
}

}  // namespace ofm
