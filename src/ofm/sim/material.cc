#include "ofm/sim/material.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/sim/noise_tile.h"

namespace ofm {
namespace {

constexpr int kTile_px = 512;

cv::Mat Noise(RandomEngine& engine, int cells_x, int cells_y, int octaves) {
  return MakeNoiseTile(engine, kTile_px, {cells_x, cells_y, octaves});
}

cv::Mat PaintPlaster(RandomEngine& engine, const cv::Scalar& bgr) {
  cv::Mat tile = ShadeTile(bgr, Noise(engine, 4, 4, 3) + 0.5 * Noise(engine, 128, 128, 2), 9);
  for (int i = 0; i < 60; ++i) {
    const cv::Point at(static_cast<int>(UniformIndex(engine, kTile_px)),
                       static_cast<int>(UniformIndex(engine, kTile_px)));
    const int radius = 1 + static_cast<int>(UniformIndex(engine, 3));
    cv::circle(tile, at, radius, VaryColor(engine, bgr - cv::Scalar::all(22), 14), cv::FILLED,
               cv::LINE_AA);
  }
  return tile;
}

cv::Mat PaintCarpet(RandomEngine& engine, const cv::Scalar& bgr) {
  return ShadeTile(bgr, 0.5 * Noise(engine, 6, 6, 3) + Noise(engine, 128, 128, 3), 26);
}

cv::Mat PaintWood(RandomEngine& engine, const cv::Scalar& bgr) {
  return ShadeTile(bgr, Noise(engine, 4, 32, 3) + 0.5 * Noise(engine, 16, 256, 1), 22);
}

cv::Mat PaintParquet(RandomEngine& engine, const cv::Scalar& bgr) {
  constexpr int kPlank_px = 32, kLength_px = 256;
  cv::Mat tile = PaintWood(engine, bgr);
  for (int y = 0; y < kTile_px; y += kPlank_px) {
    const int start = static_cast<int>(UniformIndex(engine, kLength_px));
    for (int x = start - kLength_px; x < kTile_px; x += kLength_px) {
      const cv::Rect plank =
          cv::Rect(x, y, kLength_px, kPlank_px) & cv::Rect(0, 0, kTile_px, kTile_px);
      if (plank.empty()) continue;
      tile(plank) += cv::Scalar::all(UniformBetween(engine, 0, 26));
      cv::rectangle(tile, plank, bgr * 0.55, 1);
    }
  }
  return tile;
}

/// Squares of `step` texels with joints of `joint` texels.
cv::Mat PaintGrid(RandomEngine& engine, const cv::Scalar& bgr, int step, int joint) {
  cv::Mat tile = ShadeTile(bgr, Noise(engine, 16, 16, 4), 10);
  for (int y = 0; y < kTile_px; y += step) {
    for (int x = 0; x < kTile_px; x += step) {
      tile(cv::Rect(x, y, step, step)) += cv::Scalar::all(UniformBetween(engine, 0, 14));
      cv::rectangle(tile, cv::Rect(x, y, step, joint), bgr * 0.6, cv::FILLED);
      cv::rectangle(tile, cv::Rect(x, y, joint, step), bgr * 0.6, cv::FILLED);
    }
  }
  return tile;
}

cv::Mat PaintCeiling(RandomEngine& engine, const cv::Scalar& bgr) {
  cv::Mat tile = PaintGrid(engine, bgr, 128, 2);
  for (int i = 0; i < 900; ++i) {
    const cv::Point at(static_cast<int>(UniformIndex(engine, kTile_px)),
                       static_cast<int>(UniformIndex(engine, kTile_px)));
    cv::circle(tile, at, 1, bgr * 0.7, cv::FILLED);
  }
  return tile;
}

cv::Mat PaintStripes(RandomEngine& engine, const cv::Scalar& bgr) {
  cv::Mat tile = ShadeTile(bgr, Noise(engine, 8, 8, 3) + Noise(engine, 128, 128, 2), 12);
  const cv::Scalar other = RandomHue(engine);
  for (int y = 0; y < kTile_px; y += 64) {
    cv::rectangle(tile, cv::Rect(0, y, kTile_px, 24), other, cv::FILLED);
    cv::rectangle(tile, cv::Rect(0, y + 30, kTile_px, 5), other * 0.5, cv::FILLED);
  }
  return tile;
}

cv::Mat PaintPlaid(RandomEngine& engine, const cv::Scalar& bgr) {
  cv::Mat tile = PaintStripes(engine, bgr);
  cv::Mat turned;
  cv::rotate(PaintStripes(engine, bgr), turned, cv::ROTATE_90_CLOCKWISE);
  cv::addWeighted(tile, 0.5, turned, 0.5, 0, tile);
  return tile;
}

cv::Mat PaintSpines(RandomEngine& engine) {
  constexpr int kSpine_px = 32;
  cv::Mat tile(kTile_px, kTile_px, CV_8UC3);
  for (int y = 0; y < kTile_px; y += kSpine_px) {
    const cv::Scalar color = RandomHue(engine);
    const cv::Scalar ink =
        color[0] + color[1] + color[2] > 330 ? color * 0.25 : cv::Scalar(220, 235, 240);
    cv::rectangle(tile, cv::Rect(0, y, kTile_px, kSpine_px), color, cv::FILLED);
    cv::rectangle(tile, cv::Rect(0, y, kTile_px, 2), color * 0.5, cv::FILLED);
    for (int x = 8; x < kTile_px; x += 6 + static_cast<int>(UniformIndex(engine, 34))) {
      const int width = 3 + static_cast<int>(UniformIndex(engine, 18));
      cv::rectangle(tile, cv::Rect(x, y + 10, width, 3 + static_cast<int>(UniformIndex(engine, 9))),
                    ink, cv::FILLED);
    }
  }
  return tile;
}

cv::Mat PaintCardboard(RandomEngine& engine, const cv::Scalar& bgr) {
  cv::Mat tile = ShadeTile(bgr, Noise(engine, 4, 64, 3), 12);
  cv::rectangle(tile, cv::Rect(0, 120, kTile_px, 34), bgr * 1.25, cv::FILLED);
  for (int i = 0; i < 10; ++i) {
    const cv::Rect label(static_cast<int>(UniformIndex(engine, kTile_px - 90)),
                         static_cast<int>(UniformIndex(engine, kTile_px - 60)), 84, 52);
    cv::rectangle(tile, label, cv::Scalar(225, 230, 235), cv::FILLED);
    for (int y = 8; y < 48; y += 9) {
      const int width = 20 + static_cast<int>(UniformIndex(engine, 55));
      cv::rectangle(tile, cv::Rect(label.x + 6, label.y + y, width, 4), cv::Scalar(40, 40, 50),
                    cv::FILLED);
    }
  }
  return tile;
}

cv::Mat PaintLeaves(RandomEngine& engine, const cv::Scalar& bgr) {
  cv::Mat tile(kTile_px, kTile_px, CV_8UC3, bgr * 0.35);
  for (int i = 0; i < 900; ++i) {
    const cv::Point at(static_cast<int>(UniformIndex(engine, kTile_px)),
                       static_cast<int>(UniformIndex(engine, kTile_px)));
    cv::ellipse(tile, at, {6 + static_cast<int>(UniformIndex(engine, 22)), 5},
                UniformBetween(engine, 0, 360), 0, 360, bgr * UniformBetween(engine, 0.5, 1.3),
                cv::FILLED, cv::LINE_AA);
  }
  return tile;
}

cv::Mat PaintMaterial(Material material, const cv::Scalar& bgr, RandomEngine& engine) {
  switch (material) {
    case Material::kPlaster:
      return PaintPlaster(engine, bgr);
    case Material::kCarpet:
      return PaintCarpet(engine, bgr);
    case Material::kParquet:
      return PaintParquet(engine, bgr);
    case Material::kTiles:
      return PaintGrid(engine, bgr, 128, 3);
    case Material::kCeiling:
      return PaintCeiling(engine, bgr);
    case Material::kWood:
      return PaintWood(engine, bgr);
    case Material::kPlain:
      return ShadeTile(bgr, Noise(engine, 16, 16, 3), 5);
    case Material::kCloth:
      return ShadeTile(bgr, Noise(engine, 8, 8, 3) + Noise(engine, 128, 128, 2), 16);
    case Material::kStripes:
      return PaintStripes(engine, bgr);
    case Material::kPlaid:
      return PaintPlaid(engine, bgr);
    case Material::kSpines:
      return PaintSpines(engine);
    case Material::kCardboard:
      return PaintCardboard(engine, bgr);
    case Material::kLeaves:
      return PaintLeaves(engine, bgr);
    case Material::kSkin:
      return ShadeTile(bgr, Noise(engine, 16, 16, 2), 7);
    case Material::kHair:
      return ShadeTile(bgr, Noise(engine, 128, 8, 2), 20);
  }
  OFM_CHECK(false);
  return {};
}

double MetresPerTexel(Material material) {
  switch (material) {
    case Material::kPlaster:
      return 5e-3;
    case Material::kCarpet:
    case Material::kParquet:
    case Material::kTiles:
    case Material::kCeiling:
      return 0.6 / 128;
    case Material::kSpines:
    case Material::kStripes:
    case Material::kPlaid:
      return 1e-3;
    default:
      return 2e-3;
  }
}

}  // namespace

Texture MakeMaterial(Material material, const cv::Scalar& bgr, std::uint64_t seed) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  return {PaintMaterial(material, bgr, engine), MetresPerTexel(material)};
}

}  // namespace ofm
