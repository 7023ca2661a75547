#include "ofm/features/fast_corners.h"

#include <algorithm>

#include "ofm/base/check.h"

namespace ofm {

std::vector<Corner>& FastDetector::Detect(const PaddedImage& image, int threshold, int margin) {
  OFM_CHECK(threshold >= 0 && threshold < 255);
  OFM_CHECK(margin >= 4);
  corners_.clear();
  scores_.Resize(image.width(), image.height());
  const int width = image.width() - 2 * margin, height = image.height() - 2 * margin;
  if (width <= 0 || height <= 0) return corners_;
  columns_.resize(width + kRowPadding);
  // Scores one pixel further out: a maximum needs its neighbours.
  const auto score_row = [&](int y) {
    kernels_.fast_scores(image.Row(y) + margin - 1, image.stride(), width + 2, threshold,
                         scores_.Row(y) + margin - 1);
  };
  score_row(margin - 1);
  score_row(margin);
  for (int y = margin; y < margin + height; ++y) {
    score_row(y + 1);
    const std::uint8_t* row = scores_.Row(y) + margin;
    const int count = kernels_.find_maxima(scores_.Row(y - 1) + margin, row,
                                           scores_.Row(y + 1) + margin, width, columns_.data());
    for (int i = 0; i < count; ++i) {
      corners_.push_back({static_cast<std::uint16_t>(columns_[i] + margin),
                          static_cast<std::uint16_t>(y), row[columns_[i]]});
    }
  }
  return corners_;
}

Eigen::Vector2f FastDetector::RefinedOffset(const Corner& corner) const {
  const auto score = [&](int dx, int dy) {
    return static_cast<float>(scores_.Row(corner.y + dy)[corner.x + dx]);
  };
  const auto vertex = [](float before, float at, float after) {
    const float curvature = before - 2 * at + after;
    return curvature < 0 ? std::clamp((before - after) / (2 * curvature), -0.5f, 0.5f) : 0.0f;
  };
  return {vertex(score(-1, 0), score(0, 0), score(1, 0)),
          vertex(score(0, -1), score(0, 0), score(0, 1))};
}

}  // namespace ofm
