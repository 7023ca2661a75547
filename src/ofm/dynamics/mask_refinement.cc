#include "ofm/dynamics/mask_refinement.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "ofm/base/check.h"
#include "ofm/base/median.h"
#include "ofm/camera/depth_regions.h"
#include "ofm/perception/depth_range.h"
#include "ofm/perception/mask_growth.h"
#include "ofm/perception/mask_parts.h"

namespace ofm {
namespace {

constexpr int kScale = 2;

/// The part of an image around a mask, at half the resolution.
struct Reduced {
  cv::Rect region;  // of the whole image, in its pixels
  cv::Mat mask, depth_m;
};

Reduced Reduce(const cv::Mat& mask, const cv::Mat& depth_m, int margin_px) {
  const cv::Rect box = cv::boundingRect(mask);
  const cv::Rect wide(box.x - margin_px, box.y - margin_px, box.width + 2 * margin_px,
                      box.height + 2 * margin_px);
  Reduced reduced;
  reduced.region = wide & cv::Rect({}, mask.size());
  const cv::Size size((reduced.region.width + kScale - 1) / kScale,
                      (reduced.region.height + kScale - 1) / kScale);
  cv::resize(mask(reduced.region) != 0, reduced.mask, size, 0, 0, cv::INTER_LINEAR);
  cv::threshold(reduced.mask, reduced.mask, 127, 255, cv::THRESH_BINARY);
  cv::resize(depth_m(reduced.region), reduced.depth_m, size, 0, 0, cv::INTER_NEAREST);
  return reduced;
}

std::vector<float> DepthsOf(const DepthRegion& region, const cv::Mat& depth_m) {
  std::vector<float> depths;
  depths.reserve(region.pixels.size());
  for (const cv::Point& pixel : region.pixels) depths.push_back(depth_m.at<float>(pixel));
  return depths;
}

/// Clears the surfaces that are not the object's; gives the object's depths.
std::optional<DepthRange> TrimSurfaces(const MaskRefinementOptions& options, Reduced& reduced) {
  const auto regions =
      FindDepthRegions(reduced.mask, reduced.depth_m, static_cast<float>(options.region_step_m));
  const auto largest = std::max_element(
      regions.begin(), regions.end(),
      [](const auto& a, const auto& b) { return a.pixels.size() < b.pixels.size(); });
  std::size_t measured = 0;
  for (const DepthRegion& region : regions) measured += region.pixels.size();
  const double all = cv::countNonZero(reduced.mask);
  if (largest == regions.end() || measured < options.min_measured_share * all) return {};
  const auto range = FindDepthRange(DepthsOf(*largest, reduced.depth_m), options.depth_margin_m, 1);
  for (const DepthRegion& region : regions) {
    if (range->Contains(UpperMedian(DepthsOf(region, reduced.depth_m)))) continue;
    for (const cv::Point& pixel : region.pixels) reduced.mask.at<std::uint8_t>(pixel) = 0;
  }
  return range;
}

}  // namespace

RefinedMask RefineMask(const cv::Mat& mask, const cv::Mat& depth_m,
                       const MaskRefinementOptions& options) {
  OFM_CHECK(mask.type() == CV_8UC1 && depth_m.type() == CV_32FC1 && mask.size() == depth_m.size());
  RefinedMask refined;
  refined.mask = cv::Mat(mask.size(), CV_8UC1, cv::Scalar(0));
  const int area = cv::countNonZero(mask);
  if (area == 0) return refined;
  if (area > options.max_image_share * static_cast<double>(mask.total())) {
    refined.verdict = MaskVerdict::kDistrusted;
    return refined;
  }
  Reduced reduced = Reduce(mask, depth_m, options.growth_px + kScale);
  const int before = cv::countNonZero(reduced.mask);
  const auto range = TrimSurfaces(options, reduced);
  if (!range) {
    mask.copyTo(refined.mask);
    refined.verdict = MaskVerdict::kUnmeasured;
    return refined;
  }
  MaskGrowth growth;
  growth.distance_px = options.growth_px / kScale;
  growth.max_added = static_cast<int>(options.max_growth_share * before);
  growth.step_m = static_cast<float>(options.region_step_m);
  growth.range = *range;
  GrowAlongDepth(reduced.depth_m, growth, reduced.mask);
  KeepLargestParts(options.min_part_share, reduced.mask);
  CloseHoles(options.max_hole_px / (kScale * kScale), reduced.mask);
  cv::Mat whole;
  cv::resize(reduced.mask, whole, reduced.region.size(), 0, 0, cv::INTER_LINEAR);
  cv::threshold(whole, refined.mask(reduced.region), 127, 255, cv::THRESH_BINARY);
  return refined;
}

}  // namespace ofm
