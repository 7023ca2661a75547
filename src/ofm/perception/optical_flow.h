// Where points of one image are found in the next: pyramidal Lucas–Kanade.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "ofm/base/options.h"

namespace ofm {

struct OpticalFlowOptions {
  int window_px = 15;              ///< side of the window compared
  int levels = 4;                  ///< of the pyramid, each half the size of the one before
  int iterations = 30;             ///< at most, per level
  double epsilon_px = 0.03;        ///< a smaller step ends the iterations
  double forward_backward_px = 0;  ///< a point tracked back must return this near; 0 = no check

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("window_px", self.window_px, "side of the window compared [px]", Range{5, 63});
    visit("levels", self.levels, "levels of the image pyramid", Range{1, 8});
    visit("iterations", self.iterations, "at most, per level", Range{1, 100});
    visit("epsilon_px", self.epsilon_px, "a smaller step ends the iterations [px]", Range{1e-4, 1});
    visit("forward_backward_px", self.forward_backward_px,
          "a point tracked back must return this near [px]; 0 = no check", Range{0, 100});
  }
};

enum class FlowStatus : std::uint8_t {
  kTracked,
  kLost,          ///< no texture, no likeness, or outside the image
  kInconsistent,  ///< did not return to where it came from
};

/// Points of the previous image and where they are now; the lists have the same length.
struct FlowResult {
  std::vector<Eigen::Vector2f> previous;  ///< [px]
  std::vector<Eigen::Vector2f> current;   ///< [px]; means something only where tracked
  std::vector<FlowStatus> status;

  std::size_t size() const { return previous.size(); }
  bool IsTracked(std::size_t i) const { return status[i] == FlowStatus::kTracked; }
};

/// An image's pyramid with gradients. Copies share the images, which are never written again.
struct FlowPyramid {
  std::vector<cv::Mat> levels;  ///< as cv::buildOpticalFlowPyramid makes them; empty = none
  cv::Size size;                ///< of the image [px]
};

/// Keeps no reference to `gray` (CV_8UC1).
FlowPyramid BuildFlowPyramid(const cv::Mat& gray, const OpticalFlowOptions& options);

/// Follows `points` [px] from one image to another (Bouguet, "Pyramidal implementation of the
/// Lucas Kanade feature tracker", 2000). Both pyramids must have been made with `options`.
FlowResult TrackPoints(const FlowPyramid& previous, const FlowPyramid& current,
                       std::span<const Eigen::Vector2f> points, const OpticalFlowOptions& options);

/// Flow from image to image, each one's pyramid built once. One object serves one thread.
class OpticalFlow {
 public:
  explicit OpticalFlow(const OpticalFlowOptions& options) : options_(options) {}

  /// Where `points` of the image given last are in `gray`, which is remembered for the next call.
  /// Empty on the first call, after Reset, and where the image's size changes.
  FlowResult Advance(const cv::Mat& gray, std::span<const Eigen::Vector2f> points);

  /// Forgets the last image.
  void Reset() { pyramid_ = {}; }

  const FlowPyramid& pyramid() const { return pyramid_; }

 private:
  OpticalFlowOptions options_;
  FlowPyramid pyramid_;
};

}  // namespace ofm
