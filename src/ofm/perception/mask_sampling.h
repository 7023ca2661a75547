// A coarse mask of probabilities, interpolated at the centres of an image's pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace ofm {

/// Where a pixel's centre lies between two neighbouring cells of the mask's row or column.
struct MaskSample {
  int first, second;  ///< cells, clamped to the mask
  float weight;       ///< of the second
};

/// Samples of one axis. `pixels` are [start, size); `position` gives the place of a pixel's centre
/// (continuous image px) on the mask, where cell i spans [i, i + 1], and must not decrease.
template <class Position>
std::vector<MaskSample> MakeMaskSamples(cv::Vec2i pixels, int cells, Position&& position) {
  std::vector<MaskSample> samples(pixels[1]);
  for (int i = 0; i < pixels[1]; ++i) {
    const double centre = position(pixels[0] + i + 0.5) - 0.5;
    const double floor = std::floor(std::clamp(centre, -1.0, static_cast<double>(cells)));
    const int cell = static_cast<int>(floor);
    samples[i] = {std::clamp(cell, 0, cells - 1), std::clamp(cell + 1, 0, cells - 1),
                  static_cast<float>(std::clamp(centre - floor, 0.0, 1.0))};
  }
  return samples;
}

/// The samples of a rectangle of pixels; not empty.
struct MaskSampling {
  std::vector<MaskSample> columns, rows;

  /// The cells that are asked for.
  cv::Rect Region() const {
    return {cv::Point(columns.front().first, rows.front().first),
            cv::Point(columns.back().second + 1, rows.back().second + 1)};
  }
};

/// Sets `pixels` (CV_8UC1, columns × rows of the sampling) to 255 where the bilinear interpolation
/// of `probability` exceeds `threshold`, and to 0 elsewhere. `probability` (CV_32FC1) holds the
/// cells of sampling.Region().
void SampleMask(const cv::Mat& probability, const MaskSampling& sampling, float threshold,
                cv::Mat pixels);

/// A mask that covers `extent` [continuous image px] evenly, in an image of `image` px: 255 where
/// its bilinear interpolation at the pixel's centre exceeds `threshold` and the pixel is in `box`
/// (inside the image). Outside the mask's outermost cell centres its border goes on.
struct ProbabilityMask {
  cv::Mat values;  ///< CV_32FC1
  cv::Rect2d extent;
};
cv::Mat PasteMask(const ProbabilityMask& mask, float threshold, const cv::Rect& box,
                  cv::Size image);

}  // namespace ofm
