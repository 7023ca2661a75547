#include "ofm/sim/landmark_world.h"

#include "ofm/base/check.h"
#include "ofm/base/random.h"
#include "ofm/base/time.h"
#include "ofm/sim/normal_deviate.h"

namespace ofm {
namespace {

const Viewpoint kViewpoint{{0, -0.8, 1.35}, {0, 2.0, 1.2}};

double Uniform(RandomEngine& engine, double low, double high) {
  return low + (high - low) * UniformReal(engine);
}

}  // namespace

LandmarkWorld::LandmarkWorld(const LandmarkWorldOptions& options)
    : options_(options), path_(options.path, kViewpoint) {
  RandomEngine engine = MakeRandomEngine(options.seed, 0);
  for (int i = 0; i < options.landmarks; ++i) {
    const double x = Uniform(engine, -3, 3);
    const double y = Uniform(engine, 0.5, 4.5);
    const double z = Uniform(engine, 0, 2.6);
    landmarks_.emplace_back(x, y, z);
  }
}

StampedPose LandmarkWorld::Pose(FrameId id) const {
  OFM_CHECK(id.value < frame_count());
  const double time_s = id.value / options_.rate_hz;
  return {SecondsToNanoseconds(time_s), path_.WorldFromCamera(time_s)};
}

std::vector<LandmarkObservation> LandmarkWorld::Observe(FrameId id) const {
  constexpr double kMinDepth_m = 0.1;
  const PinholeCamera& camera = options_.camera;
  const RigidTransform camera_from_world = Pose(id).world_from_camera.Inverse();
  RandomEngine engine = MakeRandomEngine(options_.seed, 1 + std::uint64_t{id.value});
  std::vector<LandmarkObservation> observations;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Eigen::Vector3d point = camera_from_world * landmarks_[i];
    if (point.z() < kMinDepth_m || point.z() > options_.max_depth_m) continue;
    LandmarkObservation observation;
    observation.landmark = LandmarkId(static_cast<std::uint32_t>(i));
    observation.ideal_px = camera.ProjectIdeal(point);
    if (!camera.IsInImage(observation.ideal_px)) continue;
    observation.ideal_px.x() += options_.pixel_sigma * NormalDeviate(engine);
    observation.ideal_px.y() += options_.pixel_sigma * NormalDeviate(engine);
    const double depth_sigma = options_.depth_sigma * point.z() * point.z();
    observation.depth_m = point.z() + depth_sigma * NormalDeviate(engine);
    observation.is_outlier = UniformReal(engine) < options_.outlier_share;
    if (observation.is_outlier) {
      observation.ideal_px = {Uniform(engine, 0, camera.width - 1),
                              Uniform(engine, 0, camera.height - 1)};
      observation.depth_m = Uniform(engine, 0.5, options_.max_depth_m);
    }
    observations.push_back(observation);
  }
  return observations;
}

}  // namespace ofm
