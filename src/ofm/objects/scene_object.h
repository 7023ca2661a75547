// Objects of a room, and the tracks of what moved in it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/objects/oriented_box.h"

namespace ofm {

using ObjectId = Id<struct ObjectTag>;

struct ClassProbability {
  ClassId class_id;
  double probability = 0;
  friend bool operator==(const ClassProbability&, const ClassProbability&) = default;
};

/// A detection of an object: its place among the instances of a key frame.
struct ObjectSighting {
  KeyframeId keyframe;
  std::size_t instance = 0;
};

/// Something that stands still, joined from what key frames saw of it.
struct SceneObject {
  ObjectId id;                                       ///< by increasing first sight
  std::vector<ClassProbability> classes;             ///< the most probable first; they add up to 1
  OrientedBox box;                                   ///< in the world
  Eigen::Vector3d centroid_in_world = {0, 0, 0};     ///< of the points seen [m]
  std::int64_t first_seen_ns = 0, last_seen_ns = 0;  ///< key frames' times
  int views = 0;                                     ///< key frames in which it was detected
  int views_expected = 0;  ///< key frames that looked at it unhidden; at least `views`
  double confidence = 0;   ///< mean score over these, 0 where it was missed
  int point_count = 0;     ///< of its cloud, one per voxel of point_spacing_m
  Rgb color;               ///< mean
  std::vector<ObjectSighting> sightings = {};  ///< in this run; no file keeps them

  ClassId class_id() const { return classes.empty() ? ClassId() : classes.front().class_id; }
};

/// Where something that may move was at a time.
struct TrackPoint {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d position_in_world = {0, 0, 0};  ///< of the surface seen, its median [m]
  double speed_m_s = 0;
};

/// What may move, as it was followed over the frames.
struct ObjectTrack {
  InstanceId id;  ///< of the tracker of instances
  ClassId class_id;
  double score = 0;                ///< mean
  std::vector<TrackPoint> points;  ///< by increasing time, one for each frame with a place
};

/// All that is known of a room's objects. Class ids are indices into `class_names`.
struct ObjectInventory {
  std::vector<std::string> class_names;
  Eigen::Vector3d up_in_world = -Eigen::Vector3d::UnitY();  ///< as estimated; a unit vector
  std::vector<SceneObject> objects;                         ///< by id
  std::vector<ObjectTrack> tracks;                          ///< by id
};

}  // namespace ofm
