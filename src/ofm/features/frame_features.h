// A frame as tracking and mapping see it: features with ideal pixels and depth.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/features/feature_grid.h"
#include "ofm/features/features.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {

/// Features of one frame with what the camera adds to them. All lists are indexed by feature.
struct FrameFeatures {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
  std::vector<Eigen::Vector2f> ideal_px;  ///< undistorted [px]
  std::vector<float> depth_m;             ///< 0 = not measured
  std::vector<float> static_probability;  ///< 0 to 1; empty = all 1
  std::vector<char> is_aligned;           ///< place by alignment with the map; empty = none
  float aligned_noise = 1;                ///< of these places, over that of corners
  float depth_noise = 1;                  ///< of inverse depth, over what is expected of it
  /// About each feature; null in a map that was loaded.
  std::shared_ptr<const std::vector<ImagePatch>> patches;
  FeatureGrid grid;  ///< over ideal_px

  std::size_t size() const { return keypoints.size(); }
  bool IsAligned(int feature) const { return !is_aligned.empty() && is_aligned[feature] != 0; }
  float StaticProbability(int feature) const {
    return static_probability.empty() ? 1.0F : static_probability[feature];
  }
};

/// Pyramid scales by octave, so that nobody computes powers.
class OctaveScales {
 public:
  OctaveScales(int levels, double scale_factor);

  int levels() const { return static_cast<int>(scales_.size()); }
  /// scale_factor^octave.
  float Scale(int octave) const { return scales_[octave]; }
  /// The octave in which a point that octave 0 shows from `max_distance_m` appears from
  /// `distance_m`; clamped to the pyramid.
  int PredictOctave(float max_distance_m, float distance_m) const;

 private:
  std::vector<float> scales_;
};

/// Undistorts `features` and reads their depth from `depth_m` (CV_32FC1 [m], 0 = none). Places
/// without depth get 0. `static_probability` (CV_8UC1, 255 = surely static) may be empty.
std::shared_ptr<const FrameFeatures> MakeFrameFeatures(Features features, const cv::Mat& depth_m,
                                                       const PinholeCamera& camera,
                                                       const cv::Mat& static_probability = {});

/// Reads depth anew, allowing for the time between the two images: while the camera moves, the
/// depth image shows the scene from elsewhere. `depth_camera_from_color_camera` is the camera's
/// motion from the time of the colour image to that of the depth image. Features without depth at
/// the pixel where their point then is keep what they have.
std::shared_ptr<const FrameFeatures> AlignDepthInTime(
    const FrameFeatures& frame, const cv::Mat& depth_m,
    const RigidTransform& depth_camera_from_color_camera, const PinholeCamera& camera);

/// The feature's point in the camera's frame [m]; empty where depth was not measured.
std::optional<Eigen::Vector3d> PointInCamera(const FrameFeatures& features, int index,
                                             const PinholeCamera& camera);

}  // namespace ofm
