#include "ofm/perception/mask_points.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// The pyramid's gradients are Scharr's, this times the slope.
constexpr double kGradientScale = 32;

/// Gradients summed over an object's pixels in one cell.
struct CellGradients {
  double xx = 0, xy = 0, yy = 0;
  double weighted_x = 0, weighted_y = 0;  // pixel times squared gradient
  int count = 0;

  void Add(int x, int y, const cv::Vec2s& gradient) {
    const double gx = gradient[0], gy = gradient[1];
    const double energy = gx * gx + gy * gy;
    xx += gx * gx;
    xy += gx * gy;
    yy += gy * gy;
    weighted_x += energy * x;
    weighted_y += energy * y;
    ++count;
  }

  /// Root of the mean squared gradient in the weakest direction [levels / px].
  double Texture() const {
    const double half_trace = (xx + yy) / 2;
    const double half_spread = std::hypot((xx - yy) / 2, xy);
    return std::sqrt(std::max(0.0, half_trace - half_spread) / std::max(1, count)) / kGradientScale;
  }

  /// Centre of the gradients, in the pixels of the level.
  Eigen::Vector2d Centre() const {
    return Eigen::Vector2d(weighted_x, weighted_y) / std::max(1.0, xx + yy);
  }
};

int CellSide(int area, const MaskPointOptions& options) {
  const double wanted = std::sqrt(static_cast<double>(area) / options.max_points);
  return std::max(options.cell_px, static_cast<int>(std::lround(wanted)));
}

}  // namespace

std::vector<Eigen::Vector2f> FindMaskPoints(const FlowPyramid& pyramid, const cv::Mat& mask,
                                            const cv::Rect& box, const MaskPointOptions& options) {
  OFM_CHECK(mask.type() == CV_8UC1 && mask.size() == pyramid.size && pyramid.levels.size() >= 2);
  std::vector<Eigen::Vector2f> points;
  if (box.empty()) return points;
  // Half the resolution tells texture as well, at a quarter of the cost.
  const int level = pyramid.levels.size() >= 4 ? 1 : 0;
  const int scale = 1 << level;
  const cv::Mat& gradients = pyramid.levels[2 * level + 1];
  const cv::Mat object = mask(box);
  const int cell = std::max(2, CellSide(cv::countNonZero(object), options) / scale);
  const int right = std::min(gradients.cols, (box.br().x + scale - 1) / scale);
  const int bottom = std::min(gradients.rows, (box.br().y + scale - 1) / scale);
  std::vector<CellGradients> row(std::max(0, right - box.x / scale) / cell + 1);
  for (int top = box.y / scale; top < bottom; top += cell) {
    std::fill(row.begin(), row.end(), CellGradients{});
    for (int y = top; y < std::min(bottom, top + cell); ++y) {
      const std::uint8_t* is_object = mask.ptr(std::min(y * scale, mask.rows - 1));
      const auto* gradient = gradients.ptr<cv::Vec2s>(y);
      for (int x = box.x / scale; x < right; ++x) {
        if (is_object[std::min(x * scale, mask.cols - 1)] == 0) continue;
        row[(x - box.x / scale) / cell].Add(x, y, gradient[x]);
      }
    }
    for (const CellGradients& sums : row) {
      if (sums.count * 4 < cell * cell || sums.Texture() < options.min_texture) continue;
      points.emplace_back((sums.Centre() * scale).cast<float>());
    }
  }
  return points;
}

}  // namespace ofm
