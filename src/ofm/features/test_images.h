// Images for the tests of this module.
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/random.h"

namespace ofm {

/// Rectangles and discs of any grey, a little smoothed: corners all over.
inline cv::Mat TexturedImage(int width, int height, std::uint64_t seed = 1) {
  cv::Mat image(height, width, CV_8UC1, cv::Scalar(128));
  RandomEngine engine = MakeRandomEngine(seed, 0);
  const auto draw = [&](int bound) {
    return static_cast<int>(UniformIndex(engine, static_cast<std::uint32_t>(bound)));
  };
  const int shapes = width * height / 600;
  for (int i = 0; i < shapes; ++i) {
    const cv::Point corner(draw(width), draw(height));
    const int gray = draw(256), size = 4 + draw(30);
    if (i % 3 == 0) {
      cv::circle(image, corner, size / 2, gray, cv::FILLED);
    } else {
      cv::rectangle(image, cv::Rect(corner, cv::Size(size, 4 + draw(30))), gray, cv::FILLED);
    }
  }
  cv::GaussianBlur(image, image, {}, 0.8);
  return image;
}

/// Independent pixels of all values: the worst case for kernels.
inline cv::Mat NoiseImage(int width, int height, std::uint64_t seed = 1) {
  cv::Mat image(height, width, CV_8UC1);
  RandomEngine engine = MakeRandomEngine(seed, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(UniformIndex(engine, 256));
    }
  }
  return image;
}

}  // namespace ofm
