#include "ofm/perception/mask_propagation.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/perception/depth_range.h"
#include "ofm/perception/mask_growth.h"
#include "ofm/perception/mask_parts.h"
#include "ofm/perception/mask_upsampling.h"

namespace ofm {
namespace {

/// Fewer measured depths, or a smaller share of the cells, tell nothing of an object.
constexpr std::size_t kMinDepths = 4;
constexpr double kMinMeasured = 0.2;
/// How fast an object comes nearer or goes away.
constexpr double kMaxSpeed_m_s = 2;
constexpr int kMinArea_px = 64;
/// How far around what flow tells a mask may grow where flow knows nothing.
constexpr int kReach_px = 64;

/// Origins as OpenCV follows them fastest.
struct FixedOrigins {
  cv::Mat whole, fraction;
};

FixedOrigins Fix(const cv::Mat& origins) {
  FixedOrigins fixed;
  cv::convertMaps(origins, cv::noArray(), fixed.whole, fixed.fraction, CV_16SC2);
  return fixed;
}

cv::Mat Follow(const cv::Mat& image, const FixedOrigins& origins) {
  cv::Mat result;
  cv::remap(image, result, origins.whole, origins.fraction, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return result;
}

/// `rect` and so many cells around it, as far as there are.
cv::Rect Around(const cv::Rect& rect, int cells, cv::Size size) {
  return (rect - cv::Point(cells, cells) + cv::Size(2 * cells, 2 * cells)) & cv::Rect({}, size);
}

}  // namespace

MaskPropagation::MaskPropagation(const IdealLattice& cells, const MaskPropagationOptions& options)
    : cells_(cells), options_(options) {
  const cv::Size image = cells.nearest_points().size();
  seen_ = cells.SampleNearest(cv::Mat(image, CV_8UC1, cv::Scalar(255)));
}

MaskSource MaskPropagation::Prepare(std::vector<Instance> instances,
                                    const cv::Mat& cell_depth_m) const {
  OFM_CHECK(cell_depth_m.size() == cells_.size());
  MaskSource source;
  for (const Instance& instance : instances) {
    OFM_CHECK(instance.mask.size() == cells_.nearest_points().size());
    source.cells.push_back(cells_.SampleMean(instance.mask));
    source.depths.push_back(FindDepths(source.cells.back() > 127, cell_depth_m));
  }
  source.instances = std::move(instances);
  return source;
}

std::vector<Instance> MaskPropagation::Carry(const MaskSource& source,
                                             const MaskTarget& target) const {
  OFM_CHECK(target.origins.size() == cells_.size() && target.cell_depth_m.size() == cells_.size());
  const FixedOrigins origins = Fix(target.origins);
  const cv::Mat free = Follow(seen_, origins) < 255;
  std::vector<Instance> carried;
  std::vector<cv::Mat> masks;
  for (std::size_t i = 0; i < source.instances.size(); ++i) {
    cv::Mat mask = Follow(source.cells[i], origins) > 127;
    const auto& depths = source.depths[i];
    if (depths) {
      const auto way_m = static_cast<float>(kMaxSpeed_m_s * target.age_s);
      TrimToDepth(target.cell_depth_m, {depths->near_m - way_m, depths->far_m + way_m}, mask);
    }
    const cv::Rect around = Around(cv::boundingRect(mask), InCells(kReach_px), mask.size());
    if (around.empty()) continue;
    cv::Mat part = mask(around);
    if (depths) FitToDepth(target.cell_depth_m(around), free(around), part);
    if (!Tidy(part)) continue;
    carried.push_back(source.instances[i]);
    masks.push_back(std::move(mask));
  }
  masks = UpsampleMasks(cells_, masks, target.cell_depth_m, target.depth_m);
  for (std::size_t i = 0; i < carried.size(); ++i) {
    carried[i].mask = std::move(masks[i]);
    carried[i].box = cv::boundingRect(carried[i].mask);
  }
  std::erase_if(carried, [](const Instance& instance) { return instance.box.empty(); });
  return carried;
}

std::optional<DepthRange> MaskPropagation::FindDepths(const cv::Mat& mask,
                                                      const cv::Mat& depth_m) const {
  std::vector<float> depths = SampleDepths(mask, depth_m, 1);
  const auto least = static_cast<std::size_t>(kMinMeasured * static_cast<double>(depths.size()));
  return FindDepthRange(std::move(depths), options_.depth_margin_m, std::max(kMinDepths, least));
}

void MaskPropagation::FitToDepth(const cv::Mat& depth_m, const cv::Mat& free, cv::Mat& mask) const {
  const auto depths = FindDepths(mask, depth_m);
  if (!depths) return;
  const int carried = cv::countNonZero(mask);
  TrimToDepth(depth_m, *depths, mask);
  MaskGrowth growth;
  growth.distance_px = InCells(options_.growth_px);
  growth.max_added = static_cast<int>(options_.growth_budget * carried) - cv::countNonZero(mask);
  growth.step_m = static_cast<float>(options_.growth_step_m);
  growth.range = *depths;
  growth.free = free;
  GrowAlongDepth(depth_m, growth, mask);
}

bool MaskPropagation::Tidy(cv::Mat& mask) const {
  const int left = KeepLargestParts(options_.min_part_share, mask);
  if (left < std::max(1, InCells(InCells(kMinArea_px)))) return false;
  CloseHoles(InCells(InCells(options_.max_hole_px)), mask);
  return true;
}

}  // namespace ofm
