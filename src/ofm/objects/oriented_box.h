// Boxes that stand upright and are turned as the object is.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

namespace ofm {

/// A box around an object: its x axis is the longer horizontal side, z is up.
struct OrientedBox {
  Eigen::Vector3d center_in_world = {0, 0, 0};  ///< [m]
  Eigen::Quaterniond world_from_box = Eigen::Quaterniond::Identity();
  Eigen::Vector3d size_m = {0, 0, 0};  ///< length >= width, height along up
};

/// The box of least base area among those with `up` (a unit vector) as their axis, in steps of 1
/// degree. Its sides leave out the outermost `trim_share` (0 to 0.5) of the points on each side, so
/// that some wrong ones do not matter. Without points it is empty, at the origin.
OrientedBox FitOrientedBox(std::span<const Eigen::Vector3f> points_in_world,
                           const Eigen::Vector3d& up, double trim_share);

}  // namespace ofm
