#include "ofm/dynamics/flow_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "ofm/base/median.h"

namespace ofm {
namespace {

constexpr float kNone = -1;

/// What a cell shows; distances in image pixels.
struct Residual {
  float image_px = kNone;  // kNone: the cell cannot tell
  float flow_px = 0;
  float inverse_depth = 0;  // [1/m]
};

/// The least difference in inverse depth to what the last frame measured within one cell of
/// `place`; 0 where it measured nothing.
float InverseDepthResidual(const cv::Mat& depth_m, const Eigen::Vector2f& place,
                           float expected_depth_m) {
  const int x = static_cast<int>(std::lround(place.x()));
  const int y = static_cast<int>(std::lround(place.y()));
  float least = std::numeric_limits<float>::max();
  for (int row = std::max(0, y - 1); row <= std::min(depth_m.rows - 1, y + 1); ++row) {
    for (int column = std::max(0, x - 1); column <= std::min(depth_m.cols - 1, x + 1); ++column) {
      const float depth = depth_m.at<float>(row, column);
      if (depth > 0) least = std::min(least, std::abs(1 / depth - 1 / expected_depth_m));
    }
  }
  return least == std::numeric_limits<float>::max() ? 0 : least;
}

/// The flow [cells] that the camera's motion alone makes.
struct StaticFlow {
  cv::Mat flow;       // CV_32FC2; of cells without depth: (kUnknown, kUnknown)
  cv::Mat depth_m;    // CV_32FC1, expected in the last frame
  cv::Mat low, high;  // CV_32FC2, its bounds over the cells around

  static constexpr float kUnknown = 1e6F;
};

/// `radius`: how far (cells) the measured flow may be that of a neighbour.
StaticFlow PredictStaticFlow(const PinholeCamera& camera, const cv::Mat& depth_m,
                             const RigidTransform& last_from_current, int radius) {
  const Eigen::Matrix3f rotation = last_from_current.RotationMatrix().cast<float>();
  const Eigen::Vector3f translation = last_from_current.translation().cast<float>();
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  StaticFlow result;
  const cv::Vec2f unknown(StaticFlow::kUnknown, StaticFlow::kUnknown);
  result.flow.create(depth_m.size(), CV_32FC2);
  result.depth_m = cv::Mat::zeros(depth_m.size(), CV_32FC1);
  for (int y = 0; y < depth_m.rows; ++y) {
    for (int x = 0; x < depth_m.cols; ++x) {
      result.flow.at<cv::Vec2f>(y, x) = unknown;
      const float depth = depth_m.at<float>(y, x);
      if (depth <= 0) continue;
      const Eigen::Vector3f point =
          rotation * Eigen::Vector3f((x - cx) / fx * depth, (y - cy) / fy * depth, depth) +
          translation;
      if (point.z() <= 0) continue;
      result.flow.at<cv::Vec2f>(y, x) = {fx * point.x() / point.z() + cx - x,
                                         fy * point.y() / point.z() + cy - y};
      result.depth_m.at<float>(y, x) = point.z();
    }
  }
  const cv::Mat window = cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8UC1);
  cv::erode(result.flow, result.low, window);
  cv::Mat known = result.flow.clone();
  known.setTo(cv::Scalar(-StaticFlow::kUnknown, -StaticFlow::kUnknown), result.depth_m == 0);
  cv::dilate(known, result.high, window);
  return result;
}

/// By how much `value` is outside of [low, high].
float Outside(float value, float low, float high) {
  return std::max({low - value, value - high, 0.0F});
}

/// Where the grey value in the last image, looked up along the flow, is not the current one: the
/// flow is wrong there (hidden then, or beyond the image). CV_8UC1 per cell.
cv::Mat FindMismatch(const LatticePair& pair) {
  constexpr double kDifference = 25;
  cv::Mat places(pair.flow.size(), CV_32FC2), current, last, warped;
  for (int y = 0; y < places.rows; ++y) {
    for (int x = 0; x < places.cols; ++x) {
      places.at<cv::Vec2f>(y, x) =
          pair.flow.at<cv::Vec2f>(y, x) + cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    }
  }
  cv::resize(pair.current.gray, current, places.size(), 0, 0, cv::INTER_AREA);
  cv::resize(pair.last.gray, last, places.size(), 0, 0, cv::INTER_AREA);
  cv::remap(last, warped, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  cv::Mat difference;
  cv::absdiff(current, warped, difference);
  return difference > kDifference;
}

Residual ResidualAt(const LatticePair& pair, const StaticFlow& expected, cv::Point cell,
                    float cell_px) {
  constexpr float kBorder = 2;  // cells, where flow is not reliable
  Residual residual;
  if (expected.depth_m.at<float>(cell) == 0 || pair.current.texture.at<std::uint8_t>(cell) == 0) {
    return residual;
  }
  const cv::Vec2f flow = pair.flow.at<cv::Vec2f>(cell);
  const Eigen::Vector2f seen(cell.x + flow[0], cell.y + flow[1]);
  const bool is_inside = seen.x() >= kBorder && seen.y() >= kBorder &&
                         seen.x() <= pair.flow.cols - 1 - kBorder &&
                         seen.y() <= pair.flow.rows - 1 - kBorder;
  if (!is_inside) return residual;
  const cv::Vec2f low = expected.low.at<cv::Vec2f>(cell), high = expected.high.at<cv::Vec2f>(cell);
  residual.image_px =
      std::hypot(Outside(flow[0], low[0], high[0]), Outside(flow[1], low[1], high[1])) * cell_px;
  residual.flow_px = std::hypot(flow[0], flow[1]) * cell_px;
  residual.inverse_depth =
      InverseDepthResidual(pair.last.depth_m, seen, expected.depth_m.at<float>(cell));
  return residual;
}

/// Standard deviation [px] of the image residual over the cells that are believed static, by their
/// median (of a Rayleigh distribution).
float StaticSigma(const std::vector<Residual>& residuals, const cv::Mat& belief) {
  constexpr std::size_t kMinCells = 50;
  constexpr float kSigmaPerMedian = 1 / 1.1774F;
  std::vector<float> values;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (residuals[i].image_px != kNone && belief.ptr<float>()[i] < 0) {
      values.push_back(residuals[i].image_px);
    }
  }
  if (values.size() < kMinCells) return 0;
  return kSigmaPerMedian * UpperMedian(std::move(values));
}

/// Depths of the cells around one, where `source` is set.
struct DepthsAround {
  bool any = false, nearer = false, same = false;

  DepthsAround(const cv::Mat& source, const cv::Mat& depth_m, cv::Point cell) {
    constexpr int kReach = 4;  // cells
    constexpr float kSame_m = 0.1F;
    const float here = depth_m.at<float>(cell);
    const int bottom = std::min(cell.y + kReach, source.rows - 1);
    const int right = std::min(cell.x + kReach, source.cols - 1);
    for (int y = std::max(cell.y - kReach, 0); y <= bottom; ++y) {
      for (int x = std::max(cell.x - kReach, 0); x <= right; ++x) {
        const float depth = depth_m.at<float>(y, x);
        if (source.at<std::uint8_t>(y, x) == 0 || depth <= 0) continue;
        any = true;
        nearer |= depth < here - kSame_m;
        same |= std::abs(depth - here) <= kSame_m;
      }
    }
  }
};

/// Takes back what is said against cells beside something that moves: the flow's window reaches
/// over its edge, and what it uncovers was not to be seen before. Cells as deep as what was
/// believed to move are part of it.
void ForgiveNeighbours(const cv::Mat& depth_m, const cv::Mat& believed_moving, cv::Mat& evidence) {
  const cv::Mat against = evidence > 0;
  for (int y = 0; y < evidence.rows; ++y) {
    for (int x = 0; x < evidence.cols; ++x) {
      const cv::Point cell(x, y);
      if (against.at<std::uint8_t>(cell) == 0 || believed_moving.at<std::uint8_t>(cell) != 0) {
        continue;
      }
      const DepthsAround believed(believed_moving, depth_m, cell);
      const bool is_beside = believed.any && !believed.same;
      if (is_beside || DepthsAround(against, depth_m, cell).nearer) evidence.at<float>(cell) = 0;
    }
  }
}

}  // namespace

cv::Mat FlowEvidence(const PinholeCamera& lattice_camera, const LatticePair& pair,
                     const RigidTransform& last_from_current, const MotionOptions& options) {
  constexpr int kNeighbourhood = 2;  // cells: the flow's window reaches over edges
  const auto cell_px = static_cast<float>(options.lattice.cell_px);
  const StaticFlow expected =
      PredictStaticFlow(lattice_camera, pair.current.depth_m, last_from_current, kNeighbourhood);
  const cv::Mat mismatch = FindMismatch(pair);
  const cv::Size size = pair.flow.size();
  std::vector<Residual> residuals(size.area());
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (mismatch.at<std::uint8_t>(y, x) != 0) continue;
      residuals[y * size.width + x] = ResidualAt(pair, expected, {x, y}, cell_px);
    }
  }
  constexpr float kSigmasOfStaticCells = 1.75F;
  const float sigma_px = std::max(static_cast<float>(options.flow.pixel_sigma),
                                  kSigmasOfStaticCells * StaticSigma(residuals, pair.belief));
  cv::Mat evidence(size, CV_32FC1, cv::Scalar(0));
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const Residual& residual = residuals[i];
    if (residual.image_px == kNone) continue;
    const auto sigma = sigma_px + static_cast<float>(options.flow.sigma_per_px) * residual.flow_px;
    const float in_image = residual.image_px / sigma;
    const float along_ray =
        residual.inverse_depth / static_cast<float>(options.flow.inverse_depth_sigma);
    const double chi_square = in_image * in_image + along_ray * along_ray;
    evidence.ptr<float>()[i] =
        static_cast<float>(std::clamp((chi_square - options.flow.indifferent_chi_square) / 2,
                                      options.flow.static_log_odds, options.flow.moving_log_odds));
  }
  ForgiveNeighbours(pair.current.depth_m, pair.belief > options.belief.limit / 2, evidence);
  return evidence;
}

}  // namespace ofm
