// Moves a point into a camera and projects it, with the installed headers and libraries.
#include <ofm/camera/pinhole_camera.h>
#include <ofm/geometry/rigid_transform.h>

#include <cmath>
#include <iostream>
#include <memory>

int main() {
  const ofm::PinholeCamera camera = ofm::FindCameraPreset("tum-fr1").value();
  // On the heap, and made by the library: where a difference in alignment shows.
  const auto camera_from_world = std::make_unique<ofm::RigidTransform>(
      ofm::ExpSe3((ofm::Vector6d() << 0.1, 0, 0, 0, 0.2, 0).finished()));
  const Eigen::Vector3d point_in_camera = *camera_from_world * Eigen::Vector3d(0, 0, 2);
  const Eigen::Vector2d pixel = camera.Project(point_in_camera);
  const Eigen::Vector2d back =
      camera.ProjectIdeal(camera.UnprojectIdeal(camera.Undistort(pixel), point_in_camera.z()));
  const double error_px = (camera.Distort(back) - pixel).norm();
  std::cout << "pixel " << pixel.transpose() << ", error " << error_px << " px, alignment "
            << alignof(ofm::RigidTransform) << "\n";
  // 16: the alignment that the library is built with, whatever this program is built for.
  const bool same_layout = alignof(ofm::RigidTransform) == 16;
  return same_layout && camera.IsInImage(pixel) && error_px < 1e-6 ? 0 : 1;
}
