#include "ofm/mapping/landmark_triangulation.h"

#include <array>
#include <numbers>

#include "ofm/estimation/reprojection.h"
#include "ofm/geometry/triangulation.h"
#include "ofm/map/covisibility.h"

namespace ofm {
namespace {

/// Features that show no landmark and whose depth makes none.
std::vector<int> OpenFeatures(const Keyframe& keyframe, double close_depth_m) {
  std::vector<int> open;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const float depth = keyframe.features->depth_m[i];
    if (!keyframe.landmarks[i].valid() && (depth <= 0 || depth > close_depth_m)) {
      open.push_back(static_cast<int>(i));
    }
  }
  return open;
}

/// The least depth that a feature has [m]; 0 where none has any.
double NearestDepth(const Keyframe& keyframe) {
  float nearest = 0;
  for (const float depth : keyframe.features->depth_m) {
    if (depth > 0 && (nearest == 0 || depth < nearest)) nearest = depth;
  }
  return nearest;
}

/// One feature of a keyframe.
struct FeatureOf {
  const Keyframe& keyframe;
  int feature;

  Eigen::Vector2d IdealPx() const { return keyframe.features->ideal_px[feature].cast<double>(); }
};

Eigen::Vector2d Normalized(const PinholeCamera& camera, const Eigen::Vector2d& ideal_px) {
  return camera.UnprojectIdeal(ideal_px, 1).head<2>();
}

/// True where the point projects onto the feature within the gate.
bool Reprojects(const MeasurementModel& model, const FeatureOf& at, const Eigen::Vector3d& point) {
  const PointObservation seen = model.Observe(*at.keyframe.features, at.feature);
  return ReprojectionChiSquare(model.camera, at.keyframe.camera_from_world * point, seen) <=
         ChiSquareGate(seen);
}

std::optional<Eigen::Vector3d> Triangulate(const MeasurementModel& model, const FeatureOf& a,
                                           const FeatureOf& b, double min_parallax_deg) {
  const std::array<Ray, 2> rays = {
      Ray::FromCamera(a.keyframe.camera_from_world, Normalized(model.camera, a.IdealPx())),
      Ray::FromCamera(b.keyframe.camera_from_world, Normalized(model.camera, b.IdealPx()))};
  const auto point = TriangulateRays(rays, min_parallax_deg * std::numbers::pi / 180);
  if (!point || !Reprojects(model, a, point->point_in_world) ||
      !Reprojects(model, b, point->point_in_world)) {
    return {};
  }
  return point->point_in_world;
}

/// The most alike open feature of `b` near the epipolar line of a's feature; -1 where none is.
int FindOnEpipolarLine(const MeasurementModel& model, const FeatureOf& a, const Keyframe& b,
                       const std::vector<int>& open_in_b, int max_hamming) {
  const RigidTransform b_from_a = b.camera_from_world * a.keyframe.camera_from_world.Inverse();
  const Eigen::Matrix3d essential =
      SkewSymmetric(b_from_a.translation()) * b_from_a.RotationMatrix();
  const Eigen::Vector3d line = essential * Normalized(model.camera, a.IdealPx()).homogeneous();
  const double focal_px = 0.5 * (model.camera.fx + model.camera.fy);
  int best = -1, best_distance = max_hamming + 1;
  for (const int feature : open_in_b) {
    const int distance = HammingDistance(a.keyframe.features->descriptors[a.feature],
                                         b.features->descriptors[feature]);
    if (distance >= best_distance) continue;
    const FeatureOf other{b, feature};
    const Eigen::Vector2d normalized = Normalized(model.camera, other.IdealPx());
    const double off_line_px =
        focal_px * std::abs(line.dot(normalized.homogeneous())) / line.head<2>().norm();
    const double sigma_px = model.Observe(*b.features, feature).pixel_sigma;
    if (off_line_px * off_line_px > 3.84 * sigma_px * sigma_px) continue;
    best = feature;
    best_distance = distance;
  }
  return best;
}

}  // namespace

std::vector<LandmarkId> TriangulateWithNeighbours(Map& map, KeyframeId current,
                                                  const MeasurementModel& model,
                                                  const MappingOptions& options) {
  constexpr double kMinBaseline_m = 0.02;
  const double nearest_m = NearestDepth(map.GetKeyframe(current));
  std::vector<LandmarkId> created;
  int left = options.neighbours;
  for (const CovisibleKeyframe& neighbour : FindCovisible(map, current)) {
    if (left-- <= 0) break;
    const Keyframe b = map.GetKeyframe(neighbour.id);
    const Keyframe a = map.GetKeyframe(current);
    if ((a.CenterInWorld() - b.CenterInWorld()).norm() < kMinBaseline_m) continue;
    std::vector<int> open_in_b = OpenFeatures(b, model.CloseDepth());
    for (const int feature : OpenFeatures(a, model.CloseDepth())) {
      const int match = FindOnEpipolarLine(model, {a, feature}, b, open_in_b, options.max_hamming);
      if (match < 0) continue;
      const auto point = Triangulate(model, {a, feature}, {b, match}, options.min_parallax_deg);
      if (!point || (a.camera_from_world * *point).z() < nearest_m) continue;
      const LandmarkId id = map.AddLandmark(*point, current, feature);
      map.AddObservation(id, neighbour.id, match);
      map.RefreshLandmark(id);
      created.push_back(id);
      std::erase(open_in_b, match);
    }
  }
  return created;
}

}  // namespace ofm
