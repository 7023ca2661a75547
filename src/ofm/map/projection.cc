#include "ofm/map/projection.h"

namespace ofm {

std::optional<Projection> ProjectLandmark(const PinholeCamera& camera,
                                          const RigidTransform& camera_from_world,
                                          const Landmark& landmark, const OctaveScales& scales) {
  constexpr double kMinDepth_m = 0.05;
  constexpr double kMinViewCosine = 0.5;
  constexpr double kRangePlay = 1.2;
  const Eigen::Vector3d point = camera_from_world * landmark.position_in_world;
  if (!(point.z() > kMinDepth_m)) return {};
  Projection projection;
  projection.ideal_px = camera.ProjectIdeal(point);
  if (!camera.IsInImage(projection.ideal_px)) return {};
  projection.depth_m = point.z();
  const double distance = point.norm();
  if (distance > kRangePlay * landmark.max_distance_m ||
      kRangePlay * distance < landmark.min_distance_m) {
    return {};
  }
  const Eigen::Vector3d view_in_world = camera_from_world.rotation().conjugate() * point / distance;
  projection.view_cosine = view_in_world.dot(landmark.mean_view.cast<double>());
  if (projection.view_cosine < kMinViewCosine) return {};
  projection.octave = scales.PredictOctave(landmark.max_distance_m, static_cast<float>(distance));
  return projection;
}

}  // namespace ofm
