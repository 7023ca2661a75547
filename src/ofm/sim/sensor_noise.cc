#include "ofm/sim/sensor_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ofm/base/random.h"
#include "ofm/sim/normal_deviate.h"

namespace ofm {
namespace {

constexpr std::size_t kTableSize = std::size_t{1} << 17;

std::vector<float> DrawNormal(RandomEngine engine) {
  std::vector<float> values(kTableSize);
  for (float& value : values) value = static_cast<float>(NormalDeviate(engine));
  return values;
}

/// Where `here` and a neighbour do not belong to one surface.
bool IsDepthEdge(float here, float there) {
  constexpr float kRelativeJump = 0.04F;
  return std::abs(here - there) > kRelativeJump * std::min(here, there);
}

/// Pixels with a depth edge beside them, CV_8UC1 255.
cv::Mat FindDepthEdges(const cv::Mat& depth_m) {
  cv::Mat edges = cv::Mat::zeros(depth_m.size(), CV_8UC1);
  for (int y = 0; y < depth_m.rows; ++y) {
    const float* here = depth_m.ptr<float>(y);
    const float* below = depth_m.ptr<float>(std::min(y + 1, depth_m.rows - 1));
    for (int x = 0; x < depth_m.cols; ++x) {
      const int right = std::min(x + 1, depth_m.cols - 1);
      if (IsDepthEdge(here[x], here[right]))
        edges.at<uchar>(y, x) = edges.at<uchar>(y, right) = 255;
      if (IsDepthEdge(here[x], below[x])) {
        edges.at<uchar>(y, x) = edges.at<uchar>(std::min(y + 1, depth_m.rows - 1), x) = 255;
      }
    }
  }
  return edges;
}

}  // namespace

EnumNameList<NoiseModel> EnumNames(NoiseModel) {
  static constexpr std::array<std::pair<NoiseModel, std::string_view>, 2> kNames = {
      {{NoiseModel::kNone, "none"}, {NoiseModel::kKinect, "kinect"}}};
  return kNames;
}

SensorNoise::SensorNoise(const SensorNoiseOptions& options, const PinholeCamera& camera,
                         std::uint64_t seed)
    : options_(options), baseline_m_(camera.baseline_m), focal_px_(camera.fx), seed_(seed) {
  if (options_.model != NoiseModel::kNone) normal_ = DrawNormal(MakeRandomEngine(seed, 0));
}

float SensorNoise::Quantise(float depth_m) const {
  if (options_.disparity_step_px == 0) return depth_m;
  const double steps =
      baseline_m_ * options_.disparity_focal_px / (depth_m * options_.disparity_step_px);
  return static_cast<float>(baseline_m_ * options_.disparity_focal_px /
                            (std::round(steps) * options_.disparity_step_px));
}

void SensorNoise::DisturbDepth(std::uint32_t frame, cv::Mat& depth_m) const {
  // Rounding adds step^2 / 12: leave that much out of the normal part.
  const double rounding =
      options_.disparity_step_px / (baseline_m_ * options_.disparity_focal_px) / std::sqrt(12.0);
  const float sigma = static_cast<float>(
      std::sqrt(std::max(0.0, options_.depth_sigma * options_.depth_sigma - rounding * rounding)));
  RandomEngine engine = MakeRandomEngine(seed_, 2 * std::uint64_t{frame} + 1);
  const cv::Mat edges = FindDepthEdges(depth_m);
  for (int y = 0; y < depth_m.rows; ++y) {
    float* depth = depth_m.ptr<float>(y);
    const std::uint32_t start = UniformIndex(engine, kTableSize);
    for (int x = 0; x < depth_m.cols; ++x) {
      const bool dropped =
          edges.at<uchar>(y, x) != 0 && UniformReal(engine) < options_.edge_dropout;
      const float noise = normal_[(start + x) % kTableSize];
      const float z = depth[x];
      const bool in_range = z >= options_.min_depth_m && z <= options_.max_depth_m;
      depth[x] = dropped || !in_range ? 0 : Quantise(z + sigma * z * z * noise);
    }
  }
}

void SensorNoise::DisturbColor(std::uint32_t frame, cv::Mat& color) const {
  RandomEngine engine = MakeRandomEngine(seed_, 2 * std::uint64_t{frame} + 2);
  const float sigma = static_cast<float>(options_.image_sigma);
  for (int y = 0; y < color.rows; ++y) {
    uchar* row = color.ptr(y);
    const std::uint32_t start = UniformIndex(engine, kTableSize);
    for (int i = 0; i < 3 * color.cols; ++i) {
      row[i] = cv::saturate_cast<uchar>(row[i] + sigma * normal_[(start + i) % kTableSize]);
    }
  }
}

void SensorNoise::DropShadows(cv::Mat& depth_m) const {
  // The projector stands to the right of the camera, by the baseline, and sees the same rows. Going
  // from right to left its columns fall; what does not is behind something.
  constexpr float kTolerance_px = 0.6F;
  const float scale = static_cast<float>(focal_px_ * baseline_m_);
  for (int y = 0; y < depth_m.rows; ++y) {
    float* depth = depth_m.ptr<float>(y);
    float least = std::numeric_limits<float>::infinity();
    for (int x = depth_m.cols - 1; x >= 0; --x) {
      if (depth[x] <= 0) continue;
      const float column = static_cast<float>(x) - scale / depth[x];
      if (column > least + kTolerance_px) depth[x] = 0;
      least = std::min(least, column);
    }
  }
}

void SensorNoise::DropDark(std::uint32_t frame, const cv::Mat& color, cv::Mat& depth_m) const {
  constexpr int kBlock_px = 4, kDark = 40;
  RandomEngine engine = MakeRandomEngine(seed_, (std::uint64_t{1} << 40) + frame);
  for (int y = 0; y < depth_m.rows; y += kBlock_px) {
    for (int x = 0; x < depth_m.cols; x += kBlock_px) {
      const cv::Vec3b middle = color.at<cv::Vec3b>(y, x);
      const bool is_dark = middle[0] + middle[1] + middle[2] < 3 * kDark;
      if (!is_dark || UniformReal(engine) >= options_.dark_dropout) continue;
      depth_m(cv::Rect(x, y, kBlock_px, kBlock_px) & cv::Rect({0, 0}, depth_m.size())).setTo(0);
    }
  }
}

void SensorNoise::Apply(std::uint32_t frame, RenderedImage& image) const {
  if (options_.model == NoiseModel::kNone) return;
  if (options_.shadow > 0) DropShadows(image.depth_m);
  if (options_.dark_dropout > 0) DropDark(frame, image.color, image.depth_m);
  DisturbDepth(frame, image.depth_m);
  DisturbColor(frame, image.color);
}

}  // namespace ofm
