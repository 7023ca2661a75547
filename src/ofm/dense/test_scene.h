// A made scene of boxes for the tests of this module: exact depth, colour, labels and masks.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/labelled_frame.h"
#include "ofm/dense/labelled_point.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm::test {

struct Box {
  Eigen::Vector3d min, max;  // in the world [m]
  Rgb color;
  std::uint8_t class_id = kNoLabel;
  bool moves = false;
};

inline PinholeCamera SmallCamera() {
  PinholeCamera camera;
  camera.width = 160, camera.height = 120;
  camera.fx = camera.fy = 130, camera.cx = 79.5, camera.cy = 59.5;
  return camera;
}

/// Distance along `direction` to the box, infinite where it is missed.
inline double HitBox(const Box& box, const Eigen::Vector3d& origin,
                     const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (box.min - origin).array() / direction.array();
  const Eigen::Array3d b = (box.max - origin).array() / direction.array();
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return enter > 0 && enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

/// What the camera sees; all pixels of boxes that move are in dynamic_mask.
inline LabelledFrame Render(const PinholeCamera& camera, const std::vector<Box>& boxes,
                            const RigidTransform& world_from_camera, KeyframeId id) {
  const cv::Size size(camera.width, camera.height);
  LabelledFrame frame{id,
                      {},
                      cv::Mat(size, CV_8UC3, cv::Scalar::all(0)),
                      cv::Mat(size, CV_32FC1, cv::Scalar(0)),
                      cv::Mat(size, CV_8UC1, cv::Scalar(kNoLabel)),
                      cv::Mat(size, CV_8UC1, cv::Scalar(0)),
                      cv::Mat(size, CV_8UC1, cv::Scalar(0)),
                      {},
                      0};
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const Eigen::Vector3d ray =
          camera.UnprojectIdeal(camera.Undistort(Eigen::Vector2d(column, row)), 1);
      double nearest = 100;
      for (const Box& box : boxes) {
        const double depth =
            HitBox(box, world_from_camera.translation(), world_from_camera.rotation() * ray);
        if (depth >= nearest) continue;
        nearest = depth;
        frame.depth_m.at<float>(row, column) = static_cast<float>(depth);
        frame.color.at<cv::Vec3b>(row, column) = {box.color.b, box.color.g, box.color.r};
        frame.class_ids.at<std::uint8_t>(row, column) = box.class_id;
        frame.confidence.at<std::uint8_t>(row, column) = 230;
        frame.dynamic_mask.at<std::uint8_t>(row, column) = box.moves ? 255 : 0;
      }
    }
  }
  return frame;
}

inline RigidTransform At(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, y, z)};
}

constexpr Rgb kGrey{120, 130, 140}, kRed{200, 20, 30};
constexpr std::uint8_t kPerson = 0, kChair = 56;

/// A wall whose face is at z = 3.02 m.
inline Box Wall() { return {{-4, -4, 3.02}, {4, 4, 3.5}, kGrey, kNoLabel, false}; }
/// A chair before the wall.
inline Box Chair() { return {{.4, -.3, 2.02}, {.9, .3, 2.3}, kRed, kChair, false}; }
/// Somebody who stands `x` metres to the right.
inline Box Person(double x) {
  return {{x - .2, -.6, 1.52}, {x + .2, .6, 1.7}, {10, 200, 10}, kPerson, true};
}

}  // namespace ofm::test
