#include "ofm/report/map_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "ofm/base/check.h"
#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/label_color.h"

namespace ofm {
namespace {

constexpr double kNearest_m = 0.1, kPoint_m = 0.03, kLookedAt_m = 2;

Rgb ColorOf(MapColor color, Rgb appearance, std::uint8_t class_id) {
  if (color == MapColor::kAppearance) return appearance;
  if (class_id != kNoLabel) return LabelColor(class_id);
  const auto pale = [](std::uint8_t c) { return static_cast<std::uint8_t>(0.5 * c + 110); };
  return {pale(appearance.r), pale(appearance.g), pale(appearance.b)};
}

PinholeCamera CameraOf(const Viewpoint& viewpoint) {
  PinholeCamera camera;
  camera.width = viewpoint.size.width, camera.height = viewpoint.size.height;
  camera.fx = camera.fy = .5 * camera.width / std::tan(.5 * viewpoint.field_of_view);
  camera.cx = .5 * camera.width, camera.cy = .5 * camera.height;
  return camera;
}

/// Where a point is in the picture [px], and how far ahead.
struct Projected {
  Eigen::Vector2d pixel;
  double depth_m = 0;
};

class Projection {
 public:
  explicit Projection(const Viewpoint& viewpoint)
      : camera_(CameraOf(viewpoint)), camera_from_world_(viewpoint.world_from_camera.Inverse()) {
    OFM_CHECK(viewpoint.size.width > 0 && viewpoint.size.height > 0);
  }

  /// Empty where the point is not ahead, or too far outside the picture for integers.
  std::optional<Projected> operator()(const Eigen::Vector3d& point_in_world) const {
    constexpr double kFar_px = 1e6;
    const Eigen::Vector3d point = camera_from_world_ * point_in_world;
    if (!(point.z() > kNearest_m)) return {};
    const Eigen::Vector2d pixel = camera_.ProjectIdeal(point);
    if (!(pixel.cwiseAbs().maxCoeff() < kFar_px)) return {};
    return Projected{pixel, point.z()};
  }

  double focal_px() const { return camera_.fx; }

 private:
  PinholeCamera camera_;
  RigidTransform camera_from_world_;
};

cv::Mat BlankPicture(cv::Size size) { return {size, CV_8UC3, cv::Scalar::all(255)}; }

/// A picture in which the nearest wins.
class DepthPicture {
 public:
  explicit DepthPicture(cv::Size size)
      : picture_(BlankPicture(size)), nearest_m_(size, CV_32FC1, cv::Scalar(1e9)) {}

  void PaintSquare(const Projected& middle, int side_px, Rgb color) {
    const cv::Rect square(static_cast<int>(std::ceil(middle.pixel.x() - .5 * side_px)),
                          static_cast<int>(std::ceil(middle.pixel.y() - .5 * side_px)), side_px,
                          side_px);
    const cv::Rect seen = square & cv::Rect({}, picture_.size());
    for (int row = seen.y; row < seen.br().y; ++row) {
      for (int column = seen.x; column < seen.br().x; ++column) {
        auto& nearest = nearest_m_.at<float>(row, column);
        if (middle.depth_m >= nearest) continue;
        nearest = static_cast<float>(middle.depth_m);
        picture_.at<cv::Vec3b>(row, column) = {color.b, color.g, color.r};
      }
    }
  }
  const cv::Mat& picture() const { return picture_; }

 private:
  cv::Mat picture_, nearest_m_;
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
    bool is_drawn = true;
    for (int i = 0; i < 4; ++i) {
      Eigen::Vector3d corner = middle;
      corner[(axis + 1) % 3] += i == 0 || i == 3 ? -half : half;
      corner[(axis + 2) % 3] += i < 2 ? -half : half;
      const auto projected = project(corner);
      is_drawn = is_drawn && projected;
      if (is_drawn) face.corners.at(i) = ToSubpixels(projected->pixel);
    }
    if (is_drawn) faces.push_back(face);
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
  DepthPicture picture(viewpoint.size);
  for (const LabelledPoint& point : cloud.points) {
    const auto projected = project(point.position.cast<double>());
    if (!projected) continue;
    const auto side =
        static_cast<int>(std::lround(project.focal_px() * kPoint_m / projected->depth_m));
    picture.PaintSquare(*projected, std::max(1, side), ColorOf(color, point.color, point.class_id));
  }
  return picture.picture();
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
  cv::Mat picture = BlankPicture(viewpoint.size);
  for (const Face& face : faces) {
    cv::fillConvexPoly(picture, face.corners.data(), 4, face.color, cv::LINE_AA, kSubpixelBits);
  }
  return picture;
}

}  // namespace ofm
