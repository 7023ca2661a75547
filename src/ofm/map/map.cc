#include "ofm/map/map.h"

#include <algorithm>

#include "ofm/features/hamming.h"

namespace ofm {
namespace {

/// Follows fusions to the landmark that is left.
LandmarkId FollowReplacements(LandmarkId id, const std::vector<LandmarkId>& replacements) {
  while (id.value < replacements.size() && replacements[id.value].valid()) {
    id = replacements[id.value];
  }
  return id;
}

/// A keyframe that is in the map, and where another one was relative to it.
struct Anchored {
  const Keyframe* keyframe = nullptr;  ///< null where there is none
  RigidTransform camera_from_keyframe;
};

/// A keyframe of `keyframes`, or the one that it is anchored to, over any number of others.
template <class Keyframes>
Anchored FollowAnchors(const Keyframes& keyframes,
                       const std::map<KeyframeId, KeyframeAnchor>& anchors, KeyframeId id) {
  Anchored anchored{keyframes.Find(id), {}};
  while (anchored.keyframe == nullptr) {
    const auto anchor = anchors.find(id);
    if (anchor == anchors.end()) return {};
    anchored.camera_from_keyframe =
        anchored.camera_from_keyframe * anchor->second.removed_from_keyframe;
    id = anchor->second.keyframe;
    anchored.keyframe = keyframes.Find(id);
  }
  return anchored;
}

std::optional<RigidTransform> PoseOf(const Anchored& anchored) {
  if (anchored.keyframe == nullptr) return {};
  return anchored.camera_from_keyframe * anchored.keyframe->camera_from_world;
}

SubmapId SubmapOf(const Anchored& anchored) {
  return anchored.keyframe == nullptr ? SubmapId() : anchored.keyframe->submap;
}

/// That many of a landmark's descriptors tell which is typical: the time that takes goes with their
/// square, and a landmark that is seen again every day has no end of them.
constexpr std::size_t kMostDescriptors = 64;

/// The descriptor with the least median distance to the others (Mur-Artal et al. 2015).
Descriptor MostTypical(const std::vector<Descriptor>& descriptors) {
  std::size_t best = 0;
  int best_median = std::numeric_limits<int>::max();
  std::vector<std::uint16_t> distances(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    HammingDistances(descriptors[i], descriptors, distances);
    const auto middle = distances.begin() + (distances.size() - 1) / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle < best_median) best_median = *middle, best = i;
  }
  return descriptors[best];
}

}  // namespace

const Landmark* MapSnapshot::FindLandmark(LandmarkId id) const {
  return landmarks.Find(FollowReplacements(id, replacements));
}

std::optional<RigidTransform> MapSnapshot::FindKeyframePose(KeyframeId id) const {
  return PoseOf(FollowAnchors(keyframes, anchors, id));
}

SubmapId MapSnapshot::FindSubmap(KeyframeId id) const {
  return SubmapOf(FollowAnchors(keyframes, anchors, id));
}

std::optional<RigidTransform> Map::FindKeyframePose(KeyframeId id) const {
  return PoseOf(FollowAnchors(keyframes_, anchors_, id));
}

SubmapId Map::FindSubmap(KeyframeId id) const {
  return SubmapOf(FollowAnchors(keyframes_, anchors_, id));
}

Map::Map(OctaveScales scales, const MapSnapshot& snapshot)
    : scales_(std::move(scales)),
      keyframes_(snapshot.keyframes),
      landmarks_(snapshot.landmarks),
      replacements_(snapshot.replacements),
      anchors_(snapshot.anchors),
      latest_keyframe_(snapshot.latest_keyframe),
      vocabulary_(snapshot.vocabulary) {
  OFM_CHECK(replacements_.size() == snapshot.landmarks.ids_issued());
}

const Landmark* Map::FindLandmark(LandmarkId id) const {
  return landmarks_.Find(FollowReplacements(id, replacements_));
}

KeyframeId Map::AddKeyframe(Keyframe keyframe) {
  OFM_CHECK(keyframe.features != nullptr);
  const std::vector<LandmarkId> wanted = std::move(keyframe.landmarks);
  OFM_CHECK(wanted.size() == keyframe.features->size());
  keyframe.landmarks.assign(wanted.size(), LandmarkId());
  const bool begins_submap = !keyframe.submap.valid();
  latest_keyframe_ = keyframes_.Insert(std::move(keyframe));
  if (begins_submap) keyframes_.Edit(latest_keyframe_).submap = SubmapId(latest_keyframe_.value);
  for (std::size_t feature = 0; feature < wanted.size(); ++feature) {
    const Landmark* landmark = wanted[feature].valid() ? FindLandmark(wanted[feature]) : nullptr;
    if (landmark == nullptr || landmark->FeatureIn(latest_keyframe_) >= 0) continue;
    AddObservation(landmark->id, latest_keyframe_, static_cast<int>(feature));
  }
  return latest_keyframe_;
}

LandmarkId Map::AddLandmark(const Eigen::Vector3d& position_in_world, KeyframeId keyframe,
                            int feature) {
  Landmark landmark;
  landmark.position_in_world = position_in_world;
  landmark.first_keyframe = keyframe;
  landmark.static_probability = keyframes_.Get(keyframe).features->StaticProbability(feature);
  const LandmarkId id = landmarks_.Insert(std::move(landmark));
  replacements_.emplace_back();
  AddObservation(id, keyframe, feature);
  RefreshLandmark(id);
  return id;
}

void Map::RemoveKeyframe(KeyframeId id, KeyframeId anchor) {
  OFM_CHECK(id != anchor);
  const Keyframe& keyframe = keyframes_.Get(id);
  const RigidTransform removed_from_anchor =
      keyframe.camera_from_world * keyframes_.Get(anchor).camera_from_world.Inverse();
  const std::vector<LandmarkId> seen = keyframe.landmarks;
  for (const LandmarkId landmark : seen) {
    if (landmark.valid()) RemoveObservation(landmark, id);
  }
  anchors_[id] = {anchor, removed_from_anchor};
  keyframes_.Erase(id);
}

void Map::RemoveLandmark(LandmarkId id) {
  for (const Landmark::Observation& o : landmarks_.Get(id).observations) {
    keyframes_.Edit(o.keyframe).landmarks[o.feature] = LandmarkId();
  }
  landmarks_.Erase(id);
}

void Map::AddObservation(LandmarkId id, KeyframeId keyframe, int feature) {
  LandmarkId& slot = keyframes_.Edit(keyframe).landmarks.at(feature);
  OFM_CHECK(!slot.valid());
  Landmark& landmark = landmarks_.Edit(id);
  OFM_CHECK(landmark.FeatureIn(keyframe) < 0);
  slot = id;
  const auto later = [&](const Landmark::Observation& o) { return o.keyframe > keyframe; };
  const auto place =
      std::find_if(landmark.observations.begin(), landmark.observations.end(), later);
  landmark.observations.insert(place, {keyframe, feature});
}

void Map::RemoveObservation(LandmarkId id, KeyframeId keyframe) {
  Landmark& landmark = landmarks_.Edit(id);
  const int feature = landmark.FeatureIn(keyframe);
  OFM_CHECK(feature >= 0);
  keyframes_.Edit(keyframe).landmarks[feature] = LandmarkId();
  std::erase_if(landmark.observations,
                [&](const Landmark::Observation& o) { return o.keyframe == keyframe; });
  if (landmark.observations.empty()) landmarks_.Erase(id);
}

void Map::Fuse(LandmarkId from, LandmarkId into) {
  OFM_CHECK(from != into && landmarks_.Find(into) != nullptr);
  const Landmark gone = landmarks_.Get(from);
  RemoveLandmark(from);
  replacements_[from.value] = into;
  for (const Landmark::Observation& o : gone.observations) {
    if (landmarks_.Get(into).FeatureIn(o.keyframe) < 0) AddObservation(into, o.keyframe, o.feature);
  }
  Landmark& kept = landmarks_.Edit(into);
  kept.visible_count += gone.visible_count;
  kept.found_count += gone.found_count;
  RefreshLandmark(into);
}

void Map::SetKeyframePose(KeyframeId id, const RigidTransform& camera_from_world) {
  keyframes_.Edit(id).camera_from_world = camera_from_world;
}

void Map::JoinSubmaps(SubmapId from, SubmapId into) {
  std::vector<KeyframeId> joined;
  keyframes_.ForEach([&](const Keyframe& keyframe) {
    if (keyframe.submap == from) joined.push_back(keyframe.id);
  });
  for (const KeyframeId id : joined) keyframes_.Edit(id).submap = into;
}

void Map::SetLandmarkPosition(LandmarkId id, const Eigen::Vector3d& position_in_world) {
  landmarks_.Edit(id).position_in_world = position_in_world;
}

void Map::RefreshLandmark(LandmarkId id) {
  Landmark& landmark = landmarks_.Edit(id);
  OFM_CHECK(!landmark.observations.empty());
  Eigen::Vector3d view_sum = Eigen::Vector3d::Zero();
  for (const Landmark::Observation& o : landmark.observations) {
    const Keyframe& keyframe = keyframes_.Get(o.keyframe);
    view_sum += (landmark.position_in_world - keyframe.CenterInWorld()).normalized();
  }
  const std::size_t seen = landmark.observations.size(), count = std::min(seen, kMostDescriptors);
  std::vector<Descriptor> descriptors;
  for (std::size_t i = 0; i < count; ++i) {
    const Landmark::Observation& o = landmark.observations[i * seen / count];
    descriptors.push_back(keyframes_.Get(o.keyframe).features->descriptors[o.feature]);
  }
  landmark.mean_view = view_sum.normalized().cast<float>();
  landmark.descriptor = MostTypical(descriptors);
  const Landmark::Observation& first = landmark.observations.front();
  const Keyframe& reference = keyframes_.Get(first.keyframe);
  const int octave = reference.features->keypoints[first.feature].octave;
  const double distance = (landmark.position_in_world - reference.CenterInWorld()).norm();
  landmark.max_distance_m = static_cast<float>(distance) * scales_.Scale(octave);
  landmark.min_distance_m = landmark.max_distance_m / scales_.Scale(scales_.levels() - 1);
}

void Map::CountSightings(LandmarkId id, int visible, int found) {
  const Landmark* landmark = FindLandmark(id);
  if (landmark == nullptr) return;
  Landmark& edited = landmarks_.Edit(landmark->id);
  edited.visible_count += visible;
  edited.found_count += found;
}

void Map::UpdateStaticProbability(LandmarkId id, float seen) {
  constexpr float kGain = 0.1F;  // a dozen frames that see it move bring a sure one under 0.3
  const Landmark* landmark = FindLandmark(id);
  if (landmark == nullptr || landmark->static_probability == seen) return;
  Landmark& edited = landmarks_.Edit(landmark->id);
  edited.static_probability += kGain * (seen - edited.static_probability);
}

std::shared_ptr<const MapSnapshot> Map::Snapshot() {
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->keyframes = keyframes_.Snapshot();
  snapshot->landmarks = landmarks_.Snapshot();
  snapshot->replacements = replacements_;
  snapshot->anchors = anchors_;
  snapshot->latest_keyframe = latest_keyframe_;
  snapshot->keyframe_count = keyframes_.size();
  snapshot->landmark_count = landmarks_.size();
  snapshot->vocabulary = vocabulary_;
  return snapshot;
}

}  // namespace ofm
