// What people hid, filled in from views before and after (OFM-SLAM paper, figures 8 and 18).
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/dense/dense_options.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// A frame, where it was taken from, and where it does not show the static scene.
struct SceneView {
  std::int64_t stamp_ns = 0;
  RigidTransform world_from_camera;  ///< when the colour image was taken
  RigidTransform world_from_depth;   ///< when the depth image was taken
  cv::Mat color;                     ///< CV_8UC3, BGR
  cv::Mat depth_m;                   ///< CV_32FC1 [m], 0 = not measured
  cv::Mat hidden;                    ///< CV_8UC1, 255 = dynamic; of the images' size
};

/// A frame without what moved in it.
struct InpaintedFrame {
  cv::Mat color;    ///< CV_8UC3, BGR; black where hidden and not filled
  cv::Mat depth_m;  ///< CV_32FC1 [m]; 0 where hidden and not filled
  cv::Mat hidden;   ///< CV_8UC1, 255 = taken away: the view's, and its surroundings of like depth
  cv::Mat filled;   ///< CV_8UC1, 255 = of these, filled from other views
};

/// The static surface that a view shows: what fills others.
struct StaticView {
  std::int64_t stamp_ns = 0;
  std::vector<Eigen::Vector3f> points_in_world;  ///< [m]
  std::vector<cv::Vec3b> colors;                 ///< of each point, BGR
};

/// Fills frames of one camera. Immutable: threads may share it.
class BackgroundInpainter {
 public:
  BackgroundInpainter(const PinholeCamera& camera, const KeyframeCloudOptions& cloud,
                      const InpaintingOptions& options);

  /// The usable pixels of a view (usable_pixels.h), back-projected, with the colour that the colour
  /// image has where they lie in it.
  StaticView MakeStaticView(const SceneView& view) const;

  /// Takes the hidden pixels of `target` away and fills them with what `sources` show there: each
  /// is warped into the target's images, its brightness fitted to the target's.
  /// Of the depths that come to a pixel the nearest that enough sources agree on counts, and of
  /// these the colour of the source nearest in time.
  InpaintedFrame Inpaint(const SceneView& target,
                         std::span<const std::shared_ptr<const StaticView>> sources) const;

 private:
  std::optional<cv::Vec3b> FindColor(const cv::Mat& color,
                                     const Eigen::Vector3d& point_in_camera) const;

  PinholeCamera camera_;
  KeyframeCloudOptions cloud_;
  InpaintingOptions options_;
  UndistortionTable table_;
};

}  // namespace ofm
