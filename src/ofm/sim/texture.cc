#include "ofm/sim/texture.h"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "ofm/base/check.h"
#include "ofm/base/random.h"

namespace ofm {
namespace {

cv::Scalar RandomColor(RandomEngine& engine, double contrast) {
  // A common brightness with a spread per channel, so that grey levels differ as much as colours.
  const double brightness = 127 + contrast * (UniformReal(engine) - 0.5) * 200;
  cv::Scalar color;
  for (int c = 0; c < 3; ++c) {
    color[c] = std::clamp(brightness + contrast * (UniformReal(engine) - 0.5) * 90, 0.0, 255.0);
  }
  return color;
}

/// Paints `polygon` on the tile and on its repetitions across the borders.
void FillWrapped(cv::Mat& tile, const std::vector<cv::Point>& polygon, const cv::Scalar& color) {
  const cv::Rect box = cv::boundingRect(polygon);
  const cv::Rect whole(0, 0, tile.cols, tile.rows);
  for (const int dy : {-tile.rows, 0, tile.rows}) {
    for (const int dx : {-tile.cols, 0, tile.cols}) {
      if (((box + cv::Point(dx, dy)) & whole).empty()) continue;
      std::vector<cv::Point> moved = polygon;
      for (cv::Point& p : moved) p += cv::Point(dx, dy);
      cv::fillConvexPoly(tile, moved, color, cv::LINE_AA);
    }
  }
}

/// A triangle, quadrangle or hexagon of about `radius` texels.
std::vector<cv::Point> RandomPolygon(RandomEngine& engine, int tile_size, double radius) {
  constexpr std::array<int, 3> kCorners = {3, 4, 6};
  const int corners = kCorners[UniformIndex(engine, 3)];
  const double x = UniformReal(engine) * tile_size;
  const double y = UniformReal(engine) * tile_size;
  const double start = UniformReal(engine) * 2 * std::numbers::pi;
  const double stretch = 0.6 + 0.8 * UniformReal(engine);
  std::vector<cv::Point> polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = start + 2 * std::numbers::pi * k / corners;
    polygon.emplace_back(cvRound(x + radius * stretch * std::cos(angle)),
                         cvRound(y + radius / stretch * std::sin(angle)));
  }
  return polygon;
}

void PaintPatches(cv::Mat& tile, RandomEngine& engine, double contrast) {
  constexpr double kPatchesPerArea = 0.3;  // in units of the patch's own square
  tile.setTo(RandomColor(engine, contrast * 0.5));
  for (double radius = tile.cols / 6.0; radius >= 3; radius /= 1.8) {
    const double side = 2 * radius;
    const int count = cvRound(kPatchesPerArea * tile.cols * tile.rows / (side * side));
    for (int i = 0; i < count; ++i) {
      const std::vector<cv::Point> polygon = RandomPolygon(engine, tile.cols, radius);
      FillWrapped(tile, polygon, RandomColor(engine, contrast));
    }
  }
}

void PaintChecker(cv::Mat& tile, RandomEngine& engine, double contrast) {
  constexpr int kSquare = 16;
  const cv::Scalar offset = RandomColor(engine, 0.2);
  for (int y = 0; y < tile.rows; y += kSquare) {
    for (int x = 0; x < tile.cols; x += kSquare) {
      const double sign = ((x + y) / kSquare) % 2 == 0 ? 1 : -1;
      const cv::Scalar color = offset + cv::Scalar::all(sign * 90 * contrast);
      tile(cv::Rect(x, y, std::min(kSquare, tile.cols - x), std::min(kSquare, tile.rows - y)))
          .setTo(color);
    }
  }
}

void PaintNoise(cv::Mat& tile, RandomEngine& engine, double contrast) {
  constexpr int kCell = 32;
  const int cells = std::max(1, tile.cols / kCell);
  cv::Mat lattice(cells, cells, CV_8UC3);
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const cv::Scalar c = RandomColor(engine, contrast);
      lattice.at<cv::Vec3b>(y, x) =
          cv::Vec3b(cv::saturate_cast<uchar>(c[0]), cv::saturate_cast<uchar>(c[1]),
                    cv::saturate_cast<uchar>(c[2]));
    }
  }
  // Repeat the border cells so that the tile's edges meet.
  cv::Mat padded;
  cv::copyMakeBorder(lattice, padded, 2, 2, 2, 2, cv::BORDER_WRAP);
  cv::Mat large;
  const int scale = tile.cols / cells;
  cv::resize(padded, large, cv::Size(), scale, scale, cv::INTER_CUBIC);
  large(cv::Rect(2 * scale, 2 * scale, tile.cols, tile.rows)).copyTo(tile);
}

cv::Mat PaintTile(const TextureOptions& options, std::uint64_t seed) {
  cv::Mat tile(options.size_px, options.size_px, CV_8UC3);
  RandomEngine engine = MakeRandomEngine(seed, 0);
  switch (options.style) {
    case TextureStyle::kPatches:
      PaintPatches(tile, engine, options.contrast);
      break;
    case TextureStyle::kChecker:
      PaintChecker(tile, engine, options.contrast);
      break;
    case TextureStyle::kNoise:
      PaintNoise(tile, engine, options.contrast);
      break;
  }
  return tile;
}

}  // namespace

EnumNameList<TextureStyle> EnumNames(TextureStyle) {
  static constexpr std::array<std::pair<TextureStyle, std::string_view>, 3> kNames = {
      {{TextureStyle::kPatches, "patches"},
       {TextureStyle::kChecker, "checker"},
       {TextureStyle::kNoise, "noise"}}};
  return kNames;
}

Texture::Texture(const TextureOptions& options, std::uint64_t seed)
    : metres_per_texel_(options.metres_per_texel) {
  OFM_CHECK(options.size_px >= 32 && std::has_single_bit(static_cast<unsigned>(options.size_px)));
  OFM_CHECK(options.metres_per_texel > 0);
  cv::Mat level;
  cv::cvtColor(PaintTile(options, seed), level, cv::COLOR_BGR2BGRA);
  levels_.push_back(level);
  while (levels_.back().cols > 1) {
    cv::Mat half;
    cv::resize(levels_.back(), half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
    levels_.push_back(half);
  }
}

Eigen::Array4f Texture::SampleLevel(std::size_t level, float x, float y) const {
  const cv::Mat& image = levels_[level];
  const float scale = std::ldexp(1.0F, -static_cast<int>(level));
  // Texel centres are at half-integer positions on every level.
  const float tx = x * scale - 0.5F;
  const float ty = y * scale - 0.5F;
  const float floor_x = std::floor(tx);
  const float floor_y = std::floor(ty);
  const float ax = tx - floor_x;
  const float ay = ty - floor_y;
  const int mask = image.cols - 1;
  const int x0 = static_cast<int>(floor_x) & mask;
  const int y0 = static_cast<int>(floor_y) & mask;
  const int x1 = (x0 + 1) & mask;
  const int y1 = (y0 + 1) & mask;
  const uchar* top = image.ptr(y0);
  const uchar* bottom = image.ptr(y1);
  Eigen::Array4f color;
  for (int c = 0; c < 4; ++c) {
    const float upper = (1 - ax) * top[4 * x0 + c] + ax * top[4 * x1 + c];
    const float lower = (1 - ax) * bottom[4 * x0 + c] + ax * bottom[4 * x1 + c];
    color[c] = (1 - ay) * upper + ay * lower;
  }
  return color;
}

Eigen::Array3f Texture::Sample(float u_m, float v_m, float footprint_m) const {
  const float per_metre = static_cast<float>(1 / metres_per_texel_);
  const float x = u_m * per_metre;
  const float y = v_m * per_metre;
  const float texels = footprint_m * per_metre;
  if (!(texels > 1)) return SampleLevel(0, x, y).head<3>();
  const float level = std::log2(texels);
  const std::size_t fine = static_cast<std::size_t>(level);
  if (fine + 1 >= levels_.size()) return SampleLevel(levels_.size() - 1, x, y).head<3>();
  const float ratio = level - static_cast<float>(fine);
  return ((1 - ratio) * SampleLevel(fine, x, y) + ratio * SampleLevel(fine + 1, x, y)).head<3>();
}

}  // namespace ofm
