// The owner of keyframes and landmarks.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "ofm/features/default_vocabulary.h"
#include "ofm/map/keyframe.h"
#include "ofm/map/landmark.h"
#include "ofm/map/versioned_table.h"

namespace ofm {

/// Where a removed keyframe was, relative to one that outlived it.
struct KeyframeAnchor {
  KeyframeId keyframe;
  RigidTransform removed_from_keyframe;  ///< camera of the removed from camera of the other
};

/// An immutable copy of the map, for readers in other threads.
struct MapSnapshot {
  TableSnapshot<KeyframeId, Keyframe> keyframes;
  TableSnapshot<LandmarkId, Landmark> landmarks;
  std::vector<LandmarkId> replacements;          ///< by landmark id; see Map::Fuse
  std::map<KeyframeId, KeyframeAnchor> anchors;  ///< of removed keyframes
  KeyframeId latest_keyframe;
  std::size_t keyframe_count = 0, landmark_count = 0;
  /// By which the words of the keyframes were made. Never null.
  std::shared_ptr<const Vocabulary> vocabulary = SharedDefaultVocabulary();

  /// The landmark or what it was fused into; null where it is gone.
  const Landmark* FindLandmark(LandmarkId id) const;
  /// Pose of a keyframe, also of one that was removed; empty where it never was.
  std::optional<RigidTransform> FindKeyframePose(KeyframeId id) const;
  /// Its sub-map, likewise; invalid where it never was.
  SubmapId FindSubmap(KeyframeId id) const;
};

/// Keyframes and landmarks by id, consistent with one another: a keyframe's feature names a
/// landmark exactly where that landmark's observations name the feature. One writer; readers take
/// snapshots.
class Map {
 public:
  explicit Map(OctaveScales scales) : scales_(std::move(scales)) {}
  /// A map that goes on from `snapshot`, which does not change, with its vocabulary.
  Map(OctaveScales scales, const MapSnapshot& snapshot);

  /// Adds a keyframe whose landmarks are named by `keyframe.landmarks`; names that are gone or come
  /// twice are dropped. Sets the id. Without a sub-map it begins one, which gets the same number.
  KeyframeId AddKeyframe(Keyframe keyframe);
  /// Adds a landmark seen by one feature, with its descriptor and view taken from it.
  LandmarkId AddLandmark(const Eigen::Vector3d& position_in_world, KeyframeId keyframe,
                         int feature);

  /// Removes a keyframe and its observations; landmarks left without observer go too. The anchor
  /// keeps the poses of frames that refer to it.
  void RemoveKeyframe(KeyframeId id, KeyframeId anchor);
  void RemoveLandmark(LandmarkId id);

  /// The feature must be free, and the keyframe must not see the landmark yet.
  void AddObservation(LandmarkId landmark, KeyframeId keyframe, int feature);
  /// Removes the landmark too where it was the last observation.
  void RemoveObservation(LandmarkId landmark, KeyframeId keyframe);
  /// Hands the observations of `from` to `into` and removes it; its id then means `into`.
  void Fuse(LandmarkId from, LandmarkId into);

  void SetKeyframePose(KeyframeId id, const RigidTransform& camera_from_world);
  /// Makes the keyframes of `from` keyframes of `into`. Who moves them is another matter.
  void JoinSubmaps(SubmapId from, SubmapId into);
  void SetLandmarkPosition(LandmarkId id, const Eigen::Vector3d& position_in_world);
  /// Recomputes mean view, distance range and descriptor from the observations.
  void RefreshLandmark(LandmarkId id);
  /// Adds to the counts by which tracking judges a landmark; ignores ids that are gone.
  void CountSightings(LandmarkId id, int visible, int found);
  /// Moves the landmark's static probability towards `seen` (0 to 1), what one frame says of it;
  /// ignores ids that are gone.
  void UpdateStaticProbability(LandmarkId id, float seen);

  const Keyframe* FindKeyframe(KeyframeId id) const { return keyframes_.Find(id); }
  const Keyframe& GetKeyframe(KeyframeId id) const { return keyframes_.Get(id); }
  /// The landmark or what it was fused into; null where it is gone.
  const Landmark* FindLandmark(LandmarkId id) const;
  const Landmark& GetLandmark(LandmarkId id) const { return landmarks_.Get(id); }
  /// Pose of a keyframe, also of one that was removed; empty where it never was.
  std::optional<RigidTransform> FindKeyframePose(KeyframeId id) const;
  /// Its sub-map, likewise; invalid where it never was.
  SubmapId FindSubmap(KeyframeId id) const;
  const VersionedTable<KeyframeId, Keyframe>& keyframes() const { return keyframes_; }
  const VersionedTable<LandmarkId, Landmark>& landmarks() const { return landmarks_; }
  KeyframeId latest_keyframe() const { return latest_keyframe_; }
  const OctaveScales& scales() const { return scales_; }
  const Vocabulary& vocabulary() const { return *vocabulary_; }

  std::shared_ptr<const MapSnapshot> Snapshot();

 private:
  OctaveScales scales_;
  VersionedTable<KeyframeId, Keyframe> keyframes_;
  VersionedTable<LandmarkId, Landmark> landmarks_;
  std::vector<LandmarkId> replacements_;  // by landmark id; invalid where it was not fused
  std::map<KeyframeId, KeyframeAnchor> anchors_;
  KeyframeId latest_keyframe_;
  std::shared_ptr<const Vocabulary> vocabulary_ = SharedDefaultVocabulary();
};

}  // namespace ofm
