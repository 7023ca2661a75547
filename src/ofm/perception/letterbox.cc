#include "ofm/perception/letterbox.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"

namespace ofm {

Letterbox MakeLetterbox(cv::Size image, cv::Size input) {
  OFM_CHECK(!image.empty() && !input.empty());
  const double scale = std::min(static_cast<double>(input.width) / image.width,
                                static_cast<double>(input.height) / image.height);
  Letterbox letterbox{image, input, {}, {}};
  letterbox.resized.width =
      std::clamp(static_cast<int>(std::lround(image.width * scale)), 1, input.width);
  letterbox.resized.height =
      std::clamp(static_cast<int>(std::lround(image.height * scale)), 1, input.height);
  letterbox.upper_left = {(input.width - letterbox.resized.width) / 2,
                          (input.height - letterbox.resized.height) / 2};
  return letterbox;
}

cv::Rect ImagePixelsIn(const cv::Rect2d& box, const Letterbox& letterbox) {
  const auto first = [](double edge, int size) {
    return static_cast<int>(std::ceil(std::clamp(edge, 0.0, static_cast<double>(size)) - 0.5));
  };
  const cv::Point upper_left(first(letterbox.ImageX(box.x), letterbox.image.width),
                             first(letterbox.ImageY(box.y), letterbox.image.height));
  const cv::Point lower_right(first(letterbox.ImageX(box.x + box.width), letterbox.image.width),
                              first(letterbox.ImageY(box.y + box.height), letterbox.image.height));
  return {upper_left, lower_right};
}

cv::Mat ApplyLetterbox(const Letterbox& letterbox, const cv::Mat& image) {
  OFM_CHECK(image.type() == CV_8UC3 && image.size() == letterbox.image);
  if (letterbox.image == letterbox.input) return image;
  constexpr double kBorderGrey = 114;  // what the networks were trained with
  cv::Mat input(letterbox.input, CV_8UC3, cv::Scalar::all(kBorderGrey));
  cv::Mat inner = input(cv::Rect(letterbox.upper_left, letterbox.resized));
  cv::resize(image, inner, letterbox.resized, 0, 0, cv::INTER_LINEAR);
  return input;
}

}  // namespace ofm
