// Where a landmark should appear in a frame, and which feature it is.
#pragma once

#include <optional>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/features/frame_features.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/map/landmark.h"

namespace ofm {

/// A landmark's predicted appearance.
struct Projection {
  Eigen::Vector2d ideal_px = Eigen::Vector2d::Zero();
  double depth_m = 0;      ///< its z in the camera
  int octave = 0;          ///< at which it should be found
  double view_cosine = 1;  ///< between this view and the landmark's mean one
};

/// Empty where the landmark is behind the camera, outside of the image, outside of its distance
/// range (with a fifth of play) or seen from more than 60 degrees off its mean view (Mur-Artal et
/// al. 2015).
std::optional<Projection> ProjectLandmark(const PinholeCamera& camera,
                                          const RigidTransform& camera_from_world,
                                          const Landmark& landmark, const OctaveScales& scales);

/// What a feature must fulfil to be the projected point.
struct FeatureQuery {
  Eigen::Vector2f ideal_px = Eigen::Vector2f::Zero();
  float radius_px = 0;
  int min_octave = 0, max_octave = 0;
  float depth_m = 0;                 ///< expected z [m]; 0 = unknown
  float max_depth_difference_m = 0;  ///< between expected and measured depth; 0 = not checked
  Descriptor descriptor{};
};

struct FeatureCandidate {
  int feature = -1;                 ///< -1 = none
  int distance = 257;               ///< Hamming
  int second_distance = 257;        ///< of the next best feature
  bool second_same_octave = false;  ///< whether the next best is of the best one's octave
};

/// The feature nearest in descriptor among those that `accept(feature)` lets through.
template <class Accept>
FeatureCandidate FindFeature(const FrameFeatures& frame, const FeatureQuery& query,
                             Accept&& accept) {
  FeatureCandidate best;
  int second_octave = -1;
  frame.grid.VisitNear(query.ideal_px, query.radius_px, [&](int i) {
    const int octave = frame.keypoints[i].octave;
    if (octave < query.min_octave || octave > query.max_octave) return;
    if ((frame.ideal_px[i] - query.ideal_px).cwiseAbs().maxCoeff() > query.radius_px) return;
    if (query.max_depth_difference_m > 0 && frame.depth_m[i] > 0 &&
        std::abs(frame.depth_m[i] - query.depth_m) > query.max_depth_difference_m) {
      return;
    }
    if (!accept(i)) return;
    const int distance = HammingDistance(query.descriptor, frame.descriptors[i]);
    if (distance < best.distance) {
      best.second_distance = best.distance;
      second_octave = best.feature >= 0 ? frame.keypoints[best.feature].octave : -1;
      best.distance = distance;
      best.feature = i;
    } else if (distance < best.second_distance) {
      best.second_distance = distance;
      second_octave = octave;
    }
  });
  best.second_same_octave =
      best.feature >= 0 && second_octave == frame.keypoints[best.feature].octave;
  return best;
}

}  // namespace ofm
