#include "ofm/features/image_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "ofm/base/check.h"

namespace ofm {

void PaddedImage::Resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  stride_ = width + 2 * kRowPadding;
  pixels_.assign(static_cast<std::size_t>(stride_) * height, 0);
}

ImagePyramid::ImagePyramid(int levels, double scale_factor, const OrbKernels& kernels)
    : max_levels_(levels), scale_factor_(scale_factor), kernels_(kernels) {
  OFM_CHECK(levels >= 1);
  OFM_CHECK(scale_factor > 1 && scale_factor <= 2);
}

void ImagePyramid::Build(const cv::Mat& gray) {
  OFM_CHECK(gray.type() == CV_8UC1);
  const auto size_at = [&](int size, int level) {
    return static_cast<int>(std::lround(size / std::pow(scale_factor_, level)));
  };
  int levels = 0;
  while (levels < max_levels_ && size_at(std::min(gray.cols, gray.rows), levels) >= 1) ++levels;
  images_.resize(levels);
  smooth_.resize(levels);
  for (int level = 0; level < levels; ++level) {
    images_[level].Resize(size_at(gray.cols, level), size_at(gray.rows, level));
    smooth_[level].Resize(images_[level].width(), images_[level].height());
    if (level > 0) Downscale(images_[level - 1], images_[level]);
    if (level == 0) SmoothLevelZero(gray);
  }
}

void ImagePyramid::SmoothLevelZero(const cv::Mat& gray) {
  const int width = gray.cols, height = gray.rows;
  raw_.Resize(width, height);
  for (int y = 0; y < height; ++y) {
    std::memcpy(raw_.Row(y), gray.ptr(y), width);
    raw_.Row(y)[-1] = raw_.Row(y)[0];
    raw_.Row(y)[width] = raw_.Row(y)[width - 1];
  }
  for (int y = 0; y < height; ++y) {
    kernels_.smooth_row(raw_.Row(std::max(y - 1, 0)), raw_.Row(y),
                        raw_.Row(std::min(y + 1, height - 1)), width, images_[0].Row(y));
  }
}

ImagePyramid::Column ImagePyramid::SourceOf(int target, int size) const {
  const double source = (target + 0.5) * scale_factor_ - 0.5;
  const double left = std::floor(source);
  if (left >= size - 1) return {size - 1, 0};
  return {static_cast<int>(left), source - left};
}

void ImagePyramid::PlanRows(int source_width, int target_width) {
  blocks_.assign((target_width + 7) / 8, ResampleBlock());
  for (int x = 0; x < target_width; ++x) {
    const Column column = SourceOf(x, source_width);
    ResampleBlock& block = blocks_[x / 8];
    const int i = x % 8;
    if (i == 0) block.first = column.source;
    const auto tap = static_cast<std::uint8_t>(column.source - block.first);
    const auto weight = static_cast<std::int8_t>(std::lround(column.weight * kResampleOne));
    block.taps[2 * i] = tap;
    block.taps[2 * i + 1] = static_cast<std::uint8_t>(weight > 0 ? tap + 1 : tap);
    block.weights[2 * i] = static_cast<std::int8_t>(kResampleOne - weight);
    block.weights[2 * i + 1] = weight;
  }
}

void ImagePyramid::Downscale(const PaddedImage& source, PaddedImage& target) {
  PlanRows(source.width(), target.width());
  for (auto& row : rows_) row.resize(8 * blocks_.size() + kRowPadding);
  std::array<int, 2> held = {-1, -1};
  const auto resampled = [&](int y) -> const std::int16_t* {
    const int slot = y & 1;
    if (held[slot] != y) {
      kernels_.resample_row(source.Row(y), blocks_.data(), static_cast<int>(blocks_.size()),
                            rows_[slot].data());
      held[slot] = y;
    }
    return rows_[slot].data();
  };
  for (int y = 0; y < target.height(); ++y) {
    const Column column = SourceOf(y, source.height());
    const int weight = std::min(0x7fff, static_cast<int>(std::lround(column.weight * 0x8000)));
    const std::int16_t* upper = resampled(column.source);
    const std::int16_t* lower = resampled(std::min(column.source + 1, source.height() - 1));
    kernels_.mix_rows(upper, lower, weight, target.width(), target.Row(y));
  }
}

void ImagePyramid::Smooth(int level) {
  const PaddedImage& image = images_[level];
  PaddedImage& out = smooth_[level];
  const int width = image.width(), height = image.height();
  column_sums_.resize(width + 2 * kRowPadding);
  std::uint8_t* sums = column_sums_.data() + kRowPadding;
  for (int y = 0; y < height; ++y) {
    std::array<const std::uint8_t*, 7> rows;
    for (int i = 0; i < 7; ++i) rows[i] = image.Row(std::clamp(y + i - 3, 0, height - 1));
    kernels_.blur_columns(rows, width, sums);
    std::fill_n(sums - 3, 3, sums[0]);
    std::fill_n(sums + width, 3, sums[width - 1]);
    kernels_.blur_row(sums, width, out.Row(y));
  }
}

}  // namespace ofm
