#include "ofm/perception/mask_rcnn_input.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "ofm/base/check.h"

namespace ofm {
namespace {

int RoundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

}  // namespace

Letterbox FitMaskRcnnInput(cv::Size image, const MaskRcnnInputSize& size) {
  OFM_CHECK(!image.empty() && size.multiple > 0);
  const auto largest = [&](cv::Size room) {
    return std::min(static_cast<double>(room.width) / image.width,
                    static_cast<double>(room.height) / image.height);
  };
  double scale = 1;
  if (!size.fixed.empty()) {
    scale = largest(size.fixed);
  } else if (size.shorter_side > 0) {
    scale = std::min(static_cast<double>(size.shorter_side) / std::min(image.width, image.height),
                     largest(size.most));
  }
  const auto scaled = [&](int side) {
    return std::max(static_cast<int>(std::lround(side * scale)), 1);
  };
  Letterbox letterbox{image, size.fixed, {scaled(image.width), scaled(image.height)}, {0, 0}};
  if (size.fixed.empty()) {
    letterbox.input = {RoundUp(letterbox.resized.width, size.multiple),
                       RoundUp(letterbox.resized.height, size.multiple)};
  }
  return letterbox;
}

cv::Mat MakeMaskRcnnBlob(const Letterbox& letterbox, const cv::Mat& image,
                         const MaskRcnnColors& colors) {
  OFM_CHECK(image.type() == CV_8UC3 && image.size() == letterbox.image);
  cv::Mat resized = image;
  if (letterbox.resized != letterbox.image) {
    cv::resize(image, resized, letterbox.resized, 0, 0, cv::INTER_LINEAR);
  }
  const cv::Rect inner(letterbox.upper_left, letterbox.resized);
  const int shape[] = {3, letterbox.input.height, letterbox.input.width};
  cv::Mat blob(3, shape, CV_32F, cv::Scalar(0));
  for (int channel = 0; channel < 3; ++channel) {
    const bool bgr = colors.order == MaskRcnnColors::Order::kBgr;
    cv::Mat plane;
    cv::extractChannel(resized, plane, bgr ? channel : 2 - channel);
    cv::Mat to(letterbox.input, CV_32F, blob.ptr<float>(channel));
    plane.convertTo(to(inner), CV_32F, colors.scale, -colors.mean[channel] * colors.scale);
  }
  return blob;
}

}  // namespace ofm
