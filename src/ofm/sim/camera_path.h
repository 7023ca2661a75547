// How the simulated camera moves.
#pragma once

#include <optional>

#include "ofm/base/options.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/sim/closed_way.h"
#include "ofm/sim/scene.h"

namespace ofm {

/// The kinds of the TUM RGB-D benchmark's sequences, and a tour that closes a loop.
enum class CameraPathKind {
  kStatic,
  kXyz,         ///< shifts along the three axes, the direction kept
  kRpy,         ///< turns about the three axes, nearly in place
  kHalfsphere,  ///< on a half sphere about the target, looking at it
  kTour,  ///< a round that ends where it began: the world's tour, looking ahead, or else a circle
          ///< about the room's middle, looking outwards
};
EnumNameList<CameraPathKind> EnumNames(CameraPathKind);

struct CameraPathOptions {
  CameraPathKind kind = CameraPathKind::kXyz;
  double amplitude_m = 0.2;   ///< of xyz; a tour's radius is 5 of them [m]
  double amplitude_deg = 15;  ///< of rpy; half of halfsphere's azimuth to each side [deg]
  double period_s =
      6;  ///< of the slowest part; halfsphere takes twice, a tour's round 4 times that
  double tour_speed_mps = 0.6;  ///< of a tour of a world that has a way for it [m/s]
  double jitter_m = 0;          ///< of the hand that holds the camera, in each axis
  double jitter_deg = 0;        ///< the same for its turns

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("kind", self.kind, "static, xyz, rpy, halfsphere or tour");
    visit("amplitude_m", self.amplitude_m, "of xyz's shifts; a tour's radius is 5 of them [m]",
          Range{0, 10});
    visit("amplitude_deg", self.amplitude_deg,
          "of rpy's turns; half of halfsphere's azimuth to each side [deg]", Range{0, 90});
    visit("period_s", self.period_s,
          "of the slowest part; half of halfsphere's, a quarter of a tour's [s]", Range{0.1, 1000});
    visit("tour_speed_mps", self.tour_speed_mps,
          "of a tour, in worlds that have a way for it, instead of the period [m/s]",
          Range{0.01, 10});
    visit("jitter_m", self.jitter_m, "tremor of the hand, in each axis [m]", Range{0, 1});
    visit("jitter_deg", self.jitter_deg, "tremor of the hand, in each turn [deg]", Range{0, 45});
  }
};

/// world_from_camera of a camera at `eye` that looks at `target`, its x axis level. The view must
/// not be vertical.
RigidTransform LookAt(const Eigen::Vector3d& eye_in_world, const Eigen::Vector3d& target_in_world);

/// A smooth path: its velocity is continuous.
class CameraPath {
 public:
  CameraPath(const CameraPathOptions& options, const Viewpoint& viewpoint);

  RigidTransform WorldFromCamera(double time_s) const;

 private:
  RigidTransform Xyz(double time_s) const;
  RigidTransform Rpy(double time_s) const;
  RigidTransform Halfsphere(double time_s) const;
  RigidTransform Tour(double time_s) const;
  RigidTransform Steady(double time_s) const;
  RigidTransform Jitter(double time_s) const;

  CameraPathOptions options_;
  Viewpoint viewpoint_;
  std::optional<ClosedWay> tour_;
};

}  // namespace ofm
