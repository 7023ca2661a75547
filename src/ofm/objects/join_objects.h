// From what key frames saw to the objects of the room.
#pragma once

#include <map>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/objects/object_hypothesis.h"
#include "ofm/objects/object_options.h"
#include "ofm/objects/scene_object.h"

namespace ofm {

/// What the joining starts from.
struct JoinInput {
  const PinholeCamera& camera;
  const std::map<KeyframeId, KeyframeObjects>& keyframes;
  /// Key frames without a pose, or with one that is not finite, are left out.
  const std::map<KeyframeId, RigidTransform>& world_from_camera;
  Eigen::Vector3d up_in_world;  ///< a unit vector; the boxes' axis
};

/// Joins observations into objects by their overlap in space: a pure function.
///
/// 1. Key frame by key frame, each observation goes to the hypothesis with which it overlaps most.
///    Of a class that the hypothesis is likely to be, a share of the smaller one must be in the
///    other (views are partial); of another class a share of both must (a network's mistake shows
///    the same thing, but a cup on a book is in the book's voxels too). Two instances of a class in
///    one key frame are two objects, unless they overlap. The others begin hypotheses.
/// 2. Hypotheses that overlap by the same rules are merged, those that overlap most first, unless
///    key frames have told them apart; then what is weak and lies within another of like size is
///    taken for a part of it (a laptop's keyboard) and dropped.
/// 3. What too few key frames saw goes. Of the rest, what is at one place is merged though few of
///    its voxels are shared, unless key frames have told it apart.
/// 4. What only few of those key frames detected that looked at its place unhidden goes.
///
/// Objects are numbered by their first sight, and then by their class.
std::vector<SceneObject> JoinObjects(const JoinInput& input, const ObjectOptions& options);

}  // namespace ofm
