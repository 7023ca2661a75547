#include "ofm/perception/dense_flow.h"

#include <algorithm>

#include "ofm/base/check.h"

namespace ofm {
namespace {
constexpr int kMinSide = 32;
}

DenseFlow::DenseFlow() : search_(cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_ULTRAFAST)) {
  search_->setFinestScale(1);  // half the image's size; the preset's quarter misses limbs
}

cv::Mat DenseFlow::Compute(const cv::Mat& from, const cv::Mat& to) {
  OFM_CHECK(from.type() == CV_8UC1 && to.type() == CV_8UC1 && from.size() == to.size());
  if (std::min(from.cols, from.rows) < kMinSide) return {};
  cv::Mat flow;
  search_->calc(from, to, flow);
  return flow;
}

}  // namespace ofm
