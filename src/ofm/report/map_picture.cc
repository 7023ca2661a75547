#include "ofm/report/map_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/dense/label_color.h"

namespace ofm {
namespace {

constexpr double kNearest_m = 0.1, kPoint_m = 0.03, kLookedAt_m = 2;
const cv::Scalar kBackground(255, 255, 255);

Rgb ColorOf(MapColor color, Rgb appearance, std::uint8_t class_id) {
  if (color == MapColor::kAppearance) return appearance;
  if (class_id != kNoLabel) return LabelColor(class_id);
  const auto pale = [](std::uint8_t c) { return static_cast<std::uint8_t>(0.5 * c + 110); };
  return {pale(appearance.r), pale(appearance.g), pale(appearance.b)};
}

/// Of points in the camera's frame.
struct Projection {
  explicit Projection(const Viewpoint& viewpoint)
      : focal_px(.5 * viewpoint.size.width / std::tan(.5 * viewpoint.field_of_view)),
        center(.5 * viewpoint.size.width, .5 * viewpoint.size.height),
        camera_from_world(viewpoint.world_from_camera.Inverse()) {
    OFM_CHECK(viewpoint.size.width > 0 && viewpoint.size.height > 0);
  }

  Eigen::Vector2d operator()(const Eigen::Vector3d& point_in_camera) const {
    return point_in_camera.head<2>() * (focal_px / point_in_camera.z()) + center;
  }

  double focal_px;
  Eigen::Vector2d center;
  RigidTransform camera_from_world;
};

/// Side of a cube that looks at the camera.
struct Face {
  double distance_m = 0;
  std::array<cv::Point, 4> corners;
  cv::Scalar color;
};

/// In 1/2^kSubpixelBits px.
constexpr int kSubpixelBits = 4;

cv::Point ToSubpixels(const Eigen::Vector2d& pixel) {
  return {static_cast<int>(std::lround(std::ldexp(pixel.x(), kSubpixelBits))),
          static_cast<int>(std::lround(std::ldexp(pixel.y(), kSubpixelBits)))};
}

cv::Scalar Shaded(Rgb color, int axis) {
  static constexpr std::array<double, 3> kLight = {.78, 1, .9};  // by the side's normal
  return {color.b * kLight[axis], color.g * kLight[axis], color.r * kLight[axis]};
}

/// Adds those of its three sides towards `eye` that lie before the camera.
void AddFaces(const LabelledVoxel& voxel, double side_m, Rgb color, const Eigen::Vector3d& eye,
              const Projection& project, std::vector<Face>& faces) {
  const Eigen::Vector3d center = voxel.center.cast<double>();
  for (int axis = 0; axis < 3; ++axis) {
    const double half = .5 * side_m, towards = eye[axis] - center[axis];
    if (std::abs(towards) <= half) continue;  // seen from within its slab: edge on or hidden
    Eigen::Vector3d middle = center;
    middle[axis] += std::copysign(half, towards);
    Face face{(middle - eye).norm(), {}, Shaded(color, axis)};
    bool is_ahead = true;
    for (int i = 0; i < 4; ++i) {
      Eigen::Vector3d corner = middle;
      corner[(axis + 1) % 3] += i == 0 || i == 3 ? -half : half;
      corner[(axis + 2) % 3] += i < 2 ? -half : half;
      const Eigen::Vector3d in_camera = project.camera_from_world * corner;
      is_ahead = is_ahead && in_camera.z() > kNearest_m;
      if (is_ahead) face.corners.at(i) = ToSubpixels(project(in_camera));
    }
    if (is_ahead) faces.push_back(face);
  }
}

}  // namespace

RigidTransform Overlook(const RigidTransform& world_from_camera, double back_m, double above_m) {
  const Eigen::Vector3d eye(0, -above_m, -back_m);
  const Eigen::Vector3d ahead = (Eigen::Vector3d(0, 0, kLookedAt_m) - eye).normalized();
  const Eigen::Vector3d right =
      Eigen::Vector3d::UnitX();  // `eye` and the point are in the y-z plane
  Eigen::Matrix3d camera_from_eye;
  camera_from_eye << right, ahead.cross(right), ahead;
  return world_from_camera * RigidTransform(camera_from_eye, eye);
}

cv::Mat DrawCloud(const LabelledCloud& cloud, const Viewpoint& viewpoint, MapColor color) {
  const Projection project(viewpoint);
  cv::Mat picture(viewpoint.size, CV_8UC3, kBackground);
  cv::Mat nearest_m(viewpoint.size, CV_32FC1, cv::Scalar(1e9));
  const cv::Rect whole({}, viewpoint.size);
  for (const LabelledPoint& point : cloud.points) {
    const Eigen::Vector3d place = project.camera_from_world * point.position.cast<double>();
    if (!(place.z() > kNearest_m)) continue;
    const Eigen::Vector2d pixel = project(place);
    if (!(pixel.cwiseAbs().maxCoeff() < 1e6)) continue;
    const int side =
        std::max(1, static_cast<int>(std::lround(project.focal_px * kPoint_m / place.z())));
    const cv::Rect square(static_cast<int>(std::ceil(pixel.x() - .5 * side)),
                          static_cast<int>(std::ceil(pixel.y() - .5 * side)), side, side);
    const cv::Rect seen = square & whole;
    const Rgb rgb = ColorOf(color, point.color, point.class_id);
    for (int row = seen.y; row < seen.br().y; ++row) {
      for (int column = seen.x; column < seen.br().x; ++column) {
        auto& nearest = nearest_m.at<float>(row, column);
        if (place.z() >= nearest) continue;
        nearest = static_cast<float>(place.z());
        picture.at<cv::Vec3b>(row, column) = {rgb.b, rgb.g, rgb.r};
      }
    }
  }
  return picture;
}

cv::Mat DrawVoxels(const VoxelSet& voxels, const Viewpoint& viewpoint, MapColor color) {
  const Projection project(viewpoint);
  const Eigen::Vector3d& eye = viewpoint.world_from_camera.translation();
  std::vector<Face> faces;
  for (const LabelledVoxel& voxel : voxels.voxels) {
    const double side_m = std::ldexp(voxels.resolution_m, voxel.size_exponent);
    AddFaces(voxel, side_m, ColorOf(color, voxel.color, voxel.class_id), eye, project, faces);
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const Face& a, const Face& b) { return a.distance_m > b.distance_m; });
  cv::Mat picture(viewpoint.size, CV_8UC3, kBackground);
  for (const Face& face : faces) {
    cv::fillConvexPoly(picture, face.corners.data(), 4, face.color, cv::LINE_AA, kSubpixelBits);
  }
  return picture;
}

}  // namespace ofm
