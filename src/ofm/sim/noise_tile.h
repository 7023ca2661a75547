// Smooth random fields that repeat, to paint with.
#pragma once

#include <opencv2/core/mat.hpp>

#include "ofm/base/random.h"

namespace ofm {

/// How fine a field is: cells of the coarsest lattice over the tile, and halvings of it.
struct NoiseGrain {
  int cells_x = 8, cells_y = 8;
  int octaves = 3;  ///< each twice as fine and half as strong as the one before
};

/// CV_32FC1 of size_px x size_px, about -1 to 1, whose edges meet (value noise).
cv::Mat MakeNoiseTile(RandomEngine& engine, int size_px, const NoiseGrain& grain);

/// A tile of one colour whose brightness follows `noise`, by `amplitude` grey levels.
cv::Mat ShadeTile(const cv::Scalar& bgr, const cv::Mat& noise, double amplitude);

/// A draw in [low, high).
inline double UniformBetween(RandomEngine& engine, double low, double high) {
  return low + (high - low) * UniformReal(engine);
}

/// `bgr` made lighter or darker by up to `spread` grey levels.
cv::Scalar VaryColor(RandomEngine& engine, const cv::Scalar& bgr, double spread);

/// A strong colour of any hue.
cv::Scalar RandomHue(RandomEngine& engine);

}  // namespace ofm
