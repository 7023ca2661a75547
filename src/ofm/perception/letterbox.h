// Fitting an image into a network's input without changing its shape, and the way back.
#pragma once

#include <opencv2/core/mat.hpp>

namespace ofm {

/// The image, scaled by one factor and centred in the network's input with grey borders, as the
/// Ultralytics exporter expects it. Coordinates here are continuous: pixel i spans [i, i + 1].
struct Letterbox {
  cv::Size image;        ///< [px]
  cv::Size input;        ///< of the network [px]
  cv::Size resized;      ///< of the scaled image in the input [px]
  cv::Point upper_left;  ///< of the scaled image in the input [px]

  /// Input pixels per image pixel. The size is rounded to whole pixels, so the two factors may
  /// differ a little: the way back uses what was really done.
  double scale_x() const { return static_cast<double>(resized.width) / image.width; }
  double scale_y() const { return static_cast<double>(resized.height) / image.height; }

  double InputX(double image_x) const { return image_x * scale_x() + upper_left.x; }
  double InputY(double image_y) const { return image_y * scale_y() + upper_left.y; }
  double ImageX(double input_x) const { return (input_x - upper_left.x) / scale_x(); }
  double ImageY(double input_y) const { return (input_y - upper_left.y) / scale_y(); }
};

/// Neither size may be empty.
Letterbox MakeLetterbox(cv::Size image, cv::Size input);

/// The image's pixels whose centres lie in `box` [input px, continuous], cut at the image's border;
/// empty where there are none.
cv::Rect ImagePixelsIn(const cv::Rect2d& box, const Letterbox& letterbox);

/// The network's input image, of the type of `image` (CV_8UC3).
cv::Mat ApplyLetterbox(const Letterbox& letterbox, const cv::Mat& image);

}  // namespace ofm
