#include "ofm/features/orb_extractor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ofm/base/check.h"
#include "ofm/features/brief_pattern.h"
#include "ofm/features/even_distribution.h"
#include "ofm/features/exclusion.h"
#include "ofm/features/fast_corners.h"
#include "ofm/features/image_pyramid.h"
#include "ofm/features/orb_kernels.h"

namespace ofm {
namespace {

/// The disc of kPatchRadius and one pixel to find maxima in must lie in the image.
constexpr int kMargin = kPatchRadius + 1;
static_assert(kMargin >= ImagePatch::kRadius);
/// Cells that take weak corners where they have no strong one [px of the level].
constexpr int kCellSize = 30;
/// A level's share of the key points goes with its scale to this power. Equal density in the
/// pyramid is -2; coarse corners are found again more often, fine ones are placed better.
constexpr double kShareExponent = -0.75;
/// Harris scores are counted in this part of a grey level.
constexpr double kResponseSteps = 32;

float OrientationOf(const CentroidMoments& moments) {
  const float angle = std::atan2(static_cast<float>(moments.y), static_cast<float>(moments.x));
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  const float positive = angle < 0 ? angle + kTurn : angle;
  return positive < kTurn ? positive : 0;
}

/// Fourth root of the Harris measure (Harris and Stephens 1988, k = 1/25) of gradients in grey
/// levels per pixel, times kResponseSteps: FAST alone also answers to edges.
std::uint16_t HarrisScore(const StructureTensor& tensor) {
  constexpr double kPixels = 49, kSobelGain = 64;
  const std::int64_t xx = tensor.xx, yy = tensor.yy, xy = tensor.xy;
  const std::int64_t trace = xx + yy;
  const double measure = static_cast<double>(xx * yy - xy * xy - trace * trace / 25);
  const double root = std::sqrt(std::max(measure, 0.0)) / (kPixels * kSobelGain);
  return static_cast<std::uint16_t>(
      std::min<double>(std::lround(kResponseSteps * std::sqrt(root)), kMaxCornerScore));
}

}  // namespace

struct OrbExtractor::Workspace {
  Workspace(const OrbOptions& options, const OrbKernels& chosen)
      : kernels(chosen),
        pyramid(options.levels, options.scale_factor, chosen),
        detectors(options.levels, FastDetector(chosen)),
        rotations(kBriefPattern) {}

  const OrbKernels& kernels;
  ImagePyramid pyramid;
  std::vector<FastDetector> detectors;  ///< one for each level
  EvenSelector selector;
  PatternRotations rotations;
  PatchBuffer patch;
};

OrbExtractor::OrbExtractor(const OrbOptions& options) : OrbExtractor(options, BestOrbKernels()) {}

OrbExtractor::OrbExtractor(const OrbOptions& options, const OrbKernels& kernels)
    : options_(options), workspace_(std::make_unique<Workspace>(options, kernels)) {}

OrbExtractor::~OrbExtractor() = default;

float OrbExtractor::ScaleOf(int octave) const {
  return static_cast<float>(std::pow(options_.scale_factor, octave));
}

Eigen::Vector2f OrbExtractor::InFullImage(const Eigen::Vector2f& pixel, int octave) const {
  const Eigen::Vector2f half = Eigen::Vector2f::Constant(0.5f);
  return (pixel + half) * ScaleOf(octave) - half;
}

Features OrbExtractor::Extract(const cv::Mat& gray, const cv::Mat& excluded, int count) {
  OFM_CHECK(gray.type() == CV_8UC1);
  OFM_CHECK(excluded.empty() || (excluded.type() == CV_8UC1 && excluded.size() == gray.size()));
  workspace_->pyramid.Build(gray);
  const std::vector<int> counts = DetectOnAllLevels(excluded, count);
  Features features;
  features.keypoints.reserve(count);
  features.descriptors.reserve(count);
  features.patches.reserve(count);
  for (std::size_t octave = 0; octave < counts.size(); ++octave) {
    if (counts[octave] > 0) Describe(static_cast<int>(octave), counts[octave], excluded, features);
  }
  return features;
}

/// Finds each level's corners; returns how many of them to take, `count` in all.
std::vector<int> OrbExtractor::DetectOnAllLevels(const cv::Mat& excluded, int count) {
  const int levels = workspace_->pyramid.levels();
  const int low = std::min(options_.min_fast_threshold, options_.fast_threshold) - 1;
  std::vector<int> available(levels);
  std::vector<double> weights(levels);
  for (int octave = 0; octave < levels; ++octave) {
    std::vector<Corner>& corners =
        workspace_->detectors[octave].Detect(workspace_->pyramid.image(octave), low, kMargin);
    if (!excluded.empty()) {
      std::erase_if(corners, [&](const Corner& corner) {
        return IsExcluded(excluded, InFullImage(Eigen::Vector2f(corner.x, corner.y), octave));
      });
    }
    DropWeakWhereStrong(corners, options_.fast_threshold, kCellSize);
    RankByHarris(octave);
    available[octave] = static_cast<int>(corners.size());
    weights[octave] = std::pow(ScaleOf(octave), kShareExponent);
  }
  return AllocateCounts(available, weights, count);
}

void OrbExtractor::RankByHarris(int octave) {
  const PaddedImage& image = workspace_->pyramid.image(octave);
  for (Corner& corner : workspace_->detectors[octave].corners()) {
    corner.score = HarrisScore(
        workspace_->kernels.structure_tensor(image.Row(corner.y) + corner.x, image.stride()));
  }
}

/// Grey levels about a corner; not whole where what is excluded is near.
ImagePatch OrbExtractor::CutPatch(const Corner& corner, int octave, const cv::Mat& excluded) const {
  constexpr int kMiddle = 6, kStep = 2;  // what is compared, and how far that may move
  const Eigen::Vector2f centre(corner.x, corner.y);
  const PaddedImage& image = workspace_->pyramid.image(octave);
  ImagePatch patch;
  patch.centre_px = InFullImage(centre, octave);
  for (int y = 0; y < ImagePatch::kSize; ++y) {
    const std::uint8_t* row =
        image.Row(corner.y + y - ImagePatch::kRadius) + corner.x - ImagePatch::kRadius;
    std::copy_n(row, ImagePatch::kSize, patch.gray.data() + y * ImagePatch::kSize);
  }
  if (excluded.empty()) return patch;
  for (int y = -kMiddle; y <= kMiddle && patch.is_whole; y += kStep) {
    for (int x = -kMiddle; x <= kMiddle; x += kStep) {
      const Eigen::Vector2f offset(static_cast<float>(x), static_cast<float>(y));
      if (IsExcluded(excluded, InFullImage(centre + offset, octave))) patch.is_whole = false;
    }
  }
  return patch;
}

/// Adds the `count` best corners of a level.
void OrbExtractor::Describe(int octave, int count, const cv::Mat& excluded, Features& features) {
  Workspace& w = *workspace_;
  w.pyramid.Smooth(octave);
  const PaddedImage& image = w.pyramid.image(octave);
  const PaddedImage& smooth = w.pyramid.smooth(octave);
  for (const Corner& corner :
       w.selector.Select(w.detectors[octave].corners(), count, options_.evenness)) {
    const Eigen::Vector2f centre(corner.x, corner.y);
    Keypoint keypoint;
    keypoint.pixel = InFullImage(centre + w.detectors[octave].RefinedOffset(corner), octave);
    if (IsExcluded(excluded, keypoint.pixel)) keypoint.pixel = InFullImage(centre, octave);
    keypoint.octave = octave;
    keypoint.response = static_cast<float>(corner.score / kResponseSteps);
    keypoint.angle_rad =
        OrientationOf(w.kernels.centroid(image.Row(corner.y) + corner.x, image.stride()));
    w.kernels.copy_patch(smooth.Row(corner.y) + corner.x, smooth.stride(), w.patch);
    features.keypoints.push_back(keypoint);
    if (options_.patches) features.patches.push_back(CutPatch(corner, octave, excluded));
    features.descriptors.push_back(w.kernels.describe(w.patch, w.rotations.At(keypoint.angle_rad)));
  }
}

}  // namespace ofm
