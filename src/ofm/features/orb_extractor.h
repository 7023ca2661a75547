// Oriented FAST and rotated BRIEF on an image pyramid, evenly spread.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "ofm/base/options.h"
#include "ofm/features/features.h"

namespace ofm {

struct Corner;
struct OrbKernels;

struct OrbOptions {
  int count = 1000;            ///< key points wanted per image
  int levels = 8;              ///< of the pyramid
  double scale_factor = 1.2;   ///< between levels
  int fast_threshold = 20;     ///< grey levels
  int min_fast_threshold = 7;  ///< grey levels, where a cell is empty at fast_threshold
  double evenness = 0.75;      ///< share chosen to cover the image; the others are the strongest
  bool patches = true;         ///< keep what is about each; for alignment alone
  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("count", self.count, "key points wanted per image", Range{50, 20000});
    visit("levels", self.levels, "levels of the image pyramid", Range{1, 16});
    visit("scale_factor", self.scale_factor, "scale between levels", Range{1.05, 2});
    visit("fast_threshold", self.fast_threshold, "FAST threshold [grey levels]", Range{1, 255});
    visit("min_fast_threshold", self.min_fast_threshold,
          "FAST threshold where a cell is empty [grey levels]", Range{1, 255});
    visit("evenness", self.evenness,
          "share of the key points chosen to cover the image; the others are the strongest",
          Range{0, 1});
  }
};

/// Extracts ORB features (Rublee et al., ICCV 2011). Keeps its buffers between calls: one object
/// serves one thread.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbOptions& options);
  /// With other inner loops than this processor's best; they outlive the extractor.
  OrbExtractor(const OrbOptions& options, const OrbKernels& kernels);
  ~OrbExtractor();

  /// About `count` (otherwise options.count) features of `gray` (CV_8UC1), none where `excluded`
  /// (empty, or CV_8UC1 of the same size) is not 0. Key points are in the full image's pixels, with
  /// sub-pixel places. The same images always give the same features. Patches are marked where what
  /// is excluded is near. Throws std::logic_error for an image of another type.
  Features Extract(const cv::Mat& gray, const cv::Mat& excluded, int count);
  Features Extract(const cv::Mat& gray, const cv::Mat& excluded = {}) {
    return Extract(gray, excluded, options_.count);
  }

  /// Scale of an octave relative to the full image: scale_factor^octave.
  float ScaleOf(int octave) const;
  const OrbOptions& options() const { return options_; }

 private:
  struct Workspace;

  Eigen::Vector2f InFullImage(const Eigen::Vector2f& pixel, int octave) const;
  std::vector<int> DetectOnAllLevels(const cv::Mat& excluded, int count);
  void RankByHarris(int octave);
  ImagePatch CutPatch(const Corner& corner, int octave, const cv::Mat& excluded) const;
  void Describe(int octave, int count, const cv::Mat& excluded, Features& features);

  OrbOptions options_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace ofm
