#include "ofm/perception/lattice_flow.h"

#include <opencv2/imgproc.hpp>

namespace ofm {

LatticeStep LatticeFlow::Process(const RgbdFrame& frame) {
  LatticeStep step{lattice_.MakeFrame(frame), {}};
  if (last_ && step.frame.stamp_ns > last_->stamp_ns) step.flow = FlowToLast(step.frame, *last_);
  last_ = step.frame;
  return step;
}

cv::Mat LatticeFlow::FlowToLast(const LatticeFrame& current, const LatticeFrame& last) {
  const cv::Mat flow = dense_flow_.Compute(current.gray, last.gray);
  if (flow.empty()) return cv::Mat::zeros(lattice_.size(), CV_32FC2);
  cv::Mat cells;
  cv::resize(flow, cells, lattice_.size(), 0, 0, cv::INTER_AREA);
  return cells / 2;  // grey values are twice as fine as cells
}

}  // namespace ofm
