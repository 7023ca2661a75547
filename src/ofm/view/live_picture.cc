#include "ofm/view/live_picture.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/pipeline/debug_view.h"

namespace ofm {

cv::Mat DrawLivePicture(const LivePicture& picture, const std::vector<std::string>& class_names) {
  const cv::Scalar green(0, 220, 0), blue(255, 120, 0);
  cv::Mat image = DrawMasks(picture.prepared, class_names);
  if (!picture.prepared.features) return image;
  const auto& keypoints = picture.prepared.features->keypoints;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const bool in_pose = i < picture.in_pose.size() && picture.in_pose[i];
    const cv::Point place(static_cast<int>(std::lround(keypoints[i].pixel.x())),
                          static_cast<int>(std::lround(keypoints[i].pixel.y())));
    cv::circle(image, place, 2, in_pose ? green : blue, cv::FILLED);
  }
  return image;
}

}  // namespace ofm
