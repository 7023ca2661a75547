// Renders the simulated world by casting a ray through every pixel.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/geometry/rigid_transform.h"
#include "ofm/sim/scene.h"

namespace ofm {

struct Surface;
struct ImageBounds;

/// What an ideal sensor sees: no noise, but the lens distortion of its camera.
struct RenderedImage {
  cv::Mat color;     ///< CV_8UC3, BGR; edges are smoothed over a pixel
  cv::Mat depth_m;   ///< CV_32FC1, z of the surface at the pixel's centre [m]; 0 = nothing there
  cv::Mat instance;  ///< CV_8UC1, InstanceId at the pixel's centre; 0 = background
};

/// Which solid is at the centre of each pixel.
struct VisibleParts {
  cv::Mat depth_m;  ///< CV_32FC1, z [m]; 0 = nothing there
  cv::Mat part;     ///< CV_32SC1, counts the parts of all bodies in their order; -1 = nothing there
};

/// Casts rays for one camera. Const, so threads may share it.
class Renderer {
 public:
  explicit Renderer(const PinholeCamera& camera);

  RenderedImage Render(const Scene& scene, double time_s,
                       const RigidTransform& world_from_camera) const;

  /// The instance image alone, without the cost of colour.
  cv::Mat RenderInstances(const Scene& scene, double time_s,
                          const RigidTransform& world_from_camera) const;

  /// The solids alone, without the cost of colour.
  VisibleParts RenderParts(const Scene& scene, double time_s,
                           const RigidTransform& world_from_camera) const;

  const PinholeCamera& camera() const { return camera_; }

 private:
  /// The nearest surface of every pixel.
  struct Visibility {
    cv::Mat depth_m;  ///< CV_32FC1, infinite where nothing is
    cv::Mat surface;  ///< CV_32SC1, index or -1
  };

  Visibility FindVisible(const std::vector<Surface>& surfaces) const;
  cv::Rect PixelBounds(const ImageBounds& bounds) const;
  cv::Mat Shade(const std::vector<Surface>& surfaces, const Visibility& visible) const;
  void SmoothEdges(const std::vector<Surface>& surfaces, const Visibility& visible,
                   cv::Mat& color) const;
  cv::Vec3b ShadeMixedPixel(const std::vector<Surface>& surfaces, const cv::Mat& visible_surface,
                            cv::Point pixel) const;

  PinholeCamera camera_;
  cv::Mat ray_x_, ray_y_;  ///< CV_32FC1: the ray of a pixel is (x, y, 1)
  /// Least and greatest ray_x_ per column and ray_y_ per row.
  std::vector<cv::Vec2f> column_range_, row_range_;
};

}  // namespace ofm
