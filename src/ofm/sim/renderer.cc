#include "ofm/sim/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ofm/sim/surface.h"

namespace ofm {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// What is seen where nothing is.
const Eigen::Array3f kBackground(60, 60, 60);

cv::Vec3b ToBytes(const Eigen::Array3f& color) {
  return {cv::saturate_cast<uchar>(color[0]), cv::saturate_cast<uchar>(color[1]),
          cv::saturate_cast<uchar>(color[2])};
}

/// First and one past the last entry of `ranges` that meets [low, high].
std::pair<int, int> OverlappingRange(const std::vector<cv::Vec2f>& ranges, float low, float high) {
  const int size = static_cast<int>(ranges.size());
  const auto meets = [&](int i) { return ranges[i][0] <= high && ranges[i][1] >= low; };
  int begin = 0;
  int end = size;
  while (begin < size && !meets(begin)) ++begin;
  while (end > begin && !meets(end - 1)) --end;
  return {begin, end};
}

/// `infinite depth` becomes 0.
cv::Mat WithoutInfinity(const cv::Mat& depth_m) {
  cv::Mat result = depth_m.clone();
  result.setTo(0, result == kInfinity);
  return result;
}

cv::Mat InstanceImage(const std::vector<Surface>& surfaces, const cv::Mat& surface) {
  cv::Mat instance = cv::Mat::zeros(surface.size(), CV_8UC1);
  for (int y = 0; y < surface.rows; ++y) {
    const int* index = surface.ptr<int>(y);
    uchar* out = instance.ptr(y);
    for (int x = 0; x < surface.cols; ++x) {
      if (index[x] >= 0) out[x] = surfaces[index[x]].instance;
    }
  }
  return instance;
}

}  // namespace

Renderer::Renderer(const PinholeCamera& camera)
    : camera_(camera),
      ray_x_(camera.height, camera.width, CV_32FC1),
      ray_y_(camera.height, camera.width, CV_32FC1),
      column_range_(camera.width, {kInfinity, -kInfinity}),
      row_range_(camera.height, {kInfinity, -kInfinity}) {
  const UndistortionTable table(camera);
  const auto extend = [](cv::Vec2f& range, float value) {
    range = {std::min(range[0], value), std::max(range[1], value)};
  };
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const Eigen::Vector3d ray = camera.UnprojectIdeal(table.At(column, row).cast<double>(), 1);
      ray_x_.at<float>(row, column) = static_cast<float>(ray.x());
      ray_y_.at<float>(row, column) = static_cast<float>(ray.y());
      extend(column_range_[column], ray_x_.at<float>(row, column));
      extend(row_range_[row], ray_y_.at<float>(row, column));
    }
  }
}

cv::Rect Renderer::PixelBounds(const ImageBounds& bounds) const {
  const auto [left, right] = OverlappingRange(column_range_, bounds.min_x, bounds.max_x);
  const auto [top, bottom] = OverlappingRange(row_range_, bounds.min_y, bounds.max_y);
  return {left, top, right - left, bottom - top};
}

Renderer::Visibility Renderer::FindVisible(const std::vector<Surface>& surfaces) const {
  Visibility visible{cv::Mat(ray_x_.size(), CV_32FC1, cv::Scalar(kInfinity)),
                     cv::Mat(ray_x_.size(), CV_32SC1, cv::Scalar(-1))};
  for (int k = 0; k < static_cast<int>(surfaces.size()); ++k) {
    const cv::Rect box = PixelBounds(surfaces[k].bounds);
    for (int y = box.y; y < box.y + box.height; ++y) {
      IntersectSpan(
          surfaces[k], k,
          {ray_x_.ptr<float>(y, box.x), ray_y_.ptr<float>(y, box.x),
           visible.depth_m.ptr<float>(y, box.x), visible.surface.ptr<int>(y, box.x), box.width});
    }
  }
  return visible;
}

cv::Mat Renderer::Shade(const std::vector<Surface>& surfaces, const Visibility& visible) const {
  const float pixel_angle = static_cast<float>(1 / std::sqrt(camera_.fx * camera_.fy));
  cv::Mat color(ray_x_.size(), CV_8UC3);
  for (int y = 0; y < color.rows; ++y) {
    const int* index = visible.surface.ptr<int>(y);
    const float* depth = visible.depth_m.ptr<float>(y);
    const float* ray_x = ray_x_.ptr<float>(y);
    const float* ray_y = ray_y_.ptr<float>(y);
    cv::Vec3b* out = color.ptr<cv::Vec3b>(y);
    for (int x = 0; x < color.cols; ++x) {
      out[x] = ToBytes(index[x] < 0 ? kBackground
                                    : ShadeSurface(surfaces[index[x]], {ray_x[x], ray_y[x]},
                                                   depth[x], pixel_angle));
    }
  }
  return color;
}

cv::Vec3b Renderer::ShadeMixedPixel(const std::vector<Surface>& surfaces,
                                    const cv::Mat& visible_surface, cv::Point pixel) const {
  constexpr int kSamples = 4;
  constexpr std::array<std::array<float, 2>, kSamples> kOffsets_px = {
      {{-0.125F, -0.375F}, {0.375F, -0.125F}, {0.125F, 0.375F}, {-0.375F, 0.125F}}};
  std::array<float, kSamples> x, y, depth;
  std::array<int, kSamples> hit;
  for (int k = 0; k < kSamples; ++k) {
    x[k] = ray_x_.at<float>(pixel) + kOffsets_px[k][0] / static_cast<float>(camera_.fx);
    y[k] = ray_y_.at<float>(pixel) + kOffsets_px[k][1] / static_cast<float>(camera_.fy);
    depth[k] = kInfinity;
    hit[k] = -1;
  }
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int index = visible_surface.at<int>(pixel.y + dy, pixel.x + dx);
      // A surface that is met again changes nothing.
      if (index >= 0) {
        IntersectSpan(surfaces[index], index,
                      {x.data(), y.data(), depth.data(), hit.data(), kSamples});
      }
    }
  }
  const float pixel_angle = static_cast<float>(1 / std::sqrt(camera_.fx * camera_.fy));
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int k = 0; k < kSamples; ++k) {
    sum += hit[k] < 0 ? kBackground
                      : ShadeSurface(surfaces[hit[k]], {x[k], y[k]}, depth[k], pixel_angle);
  }
  return ToBytes(sum / kSamples);
}

void Renderer::SmoothEdges(const std::vector<Surface>& surfaces, const Visibility& visible,
                           cv::Mat& color) const {
  const cv::Mat& surface = visible.surface;
  for (int y = 1; y + 1 < color.rows; ++y) {
    const int* above = surface.ptr<int>(y - 1);
    const int* here = surface.ptr<int>(y);
    const int* below = surface.ptr<int>(y + 1);
    for (int x = 1; x + 1 < color.cols; ++x) {
      const bool mixed = here[x] != here[x - 1] || here[x] != here[x + 1] || here[x] != above[x] ||
                         here[x] != below[x];
      if (mixed) {
        color.at<cv::Vec3b>(y, x) = ShadeMixedPixel(surfaces, surface, {x, y});
      }
    }
  }
}

RenderedImage Renderer::Render(const Scene& scene, double time_s,
                               const RigidTransform& world_from_camera) const {
  const std::vector<Surface> surfaces = MakeSurfaces(scene, time_s, world_from_camera.Inverse());
  const Visibility visible = FindVisible(surfaces);
  RenderedImage image;
  image.color = Shade(surfaces, visible);
  SmoothEdges(surfaces, visible, image.color);
  image.depth_m = WithoutInfinity(visible.depth_m);
  image.instance = InstanceImage(surfaces, visible.surface);
  return image;
}

cv::Mat Renderer::RenderInstances(const Scene& scene, double time_s,
                                  const RigidTransform& world_from_camera) const {
  const std::vector<Surface> surfaces = MakeSurfaces(scene, time_s, world_from_camera.Inverse());
  return InstanceImage(surfaces, FindVisible(surfaces).surface);
}

VisibleParts Renderer::RenderParts(const Scene& scene, double time_s,
                                   const RigidTransform& world_from_camera) const {
  const std::vector<Surface> surfaces = MakeSurfaces(scene, time_s, world_from_camera.Inverse());
  const Visibility visible = FindVisible(surfaces);
  VisibleParts parts{WithoutInfinity(visible.depth_m), visible.surface};
  for (int y = 0; y < parts.part.rows; ++y) {
    int* index = parts.part.ptr<int>(y);
    for (int x = 0; x < parts.part.cols; ++x) {
      if (index[x] >= 0) index[x] = surfaces[index[x]].part;
    }
  }
  return parts;
}

}  // namespace ofm
