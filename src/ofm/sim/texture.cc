#include "ofm/sim/texture.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
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
  for (double radius = tile.cols / 6.0; radius >= 5; radius /= 1.8) {
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

/// Four bytes of a pixel.
using PackedPixel = std::uint32_t;

/// Channel by channel, (256 - weight) / 256 of `a` and weight / 256 of `b`, rounded; two channels
/// at a time in the halves of a word.
PackedPixel LerpPixel(PackedPixel a, PackedPixel b, std::uint32_t weight) {
  constexpr std::uint32_t kEven = 0x00ff00ff;
  constexpr std::uint32_t kHalf = 0x00800080;
  const std::uint32_t rest = 256 - weight;
  const std::uint32_t even = ((a & kEven) * rest + (b & kEven) * weight + kHalf) >> 8;
  const std::uint32_t odd = ((a >> 8) & kEven) * rest + ((b >> 8) & kEven) * weight + kHalf;
  return (even & kEven) | (odd & ~kEven);
}

/// The square `image`, which repeats, at (x, y) texels from its corner; texel centres are at
/// halves.
PackedPixel SampleBilinear(const cv::Mat& image, float x, float y) {
  const auto to_fixed = [](float texels) {
    const float value = texels * 256 - 128;
    const int truncated = static_cast<int>(value);
    return truncated - (value < static_cast<float>(truncated) ? 1 : 0);
  };
  const int fixed_x = to_fixed(x);
  const int fixed_y = to_fixed(y);
  const int mask = image.cols - 1;
  const int x0 = (fixed_x >> 8) & mask;
  const int x1 = (x0 + 1) & mask;
  const int y0 = (fixed_y >> 8) & mask;
  const int y1 = (y0 + 1) & mask;
  const auto texel = [&image](int column, int row) {
    PackedPixel pixel;
    std::memcpy(&pixel, image.data + 4 * (static_cast<std::ptrdiff_t>(row) * image.cols + column),
                sizeof(pixel));
    return pixel;
  };
  const std::uint32_t weight_x = fixed_x & 255;
  return LerpPixel(LerpPixel(texel(x0, y0), texel(x1, y0), weight_x),
                   LerpPixel(texel(x0, y1), texel(x1, y1), weight_x), fixed_y & 255);
}

Eigen::Array3f ToArray(PackedPixel pixel) {
  std::array<std::uint8_t, 4> bytes;
  std::memcpy(bytes.data(), &pixel, sizeof(pixel));
  return {static_cast<float>(bytes[0]), static_cast<float>(bytes[1]), static_cast<float>(bytes[2])};
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
    : Texture(PaintTile(options, seed), options.metres_per_texel) {}

Texture::Texture(const cv::Mat& tile, double metres_per_texel) {
  OFM_CHECK(metres_per_texel > 0 && tile.type() == CV_8UC3 && tile.rows == tile.cols);
  OFM_CHECK(tile.cols >= 32 && std::has_single_bit(static_cast<unsigned>(tile.cols)));
  cv::Mat image;
  cv::cvtColor(tile, image, cv::COLOR_BGR2BGRA);
  float texels_per_metre = static_cast<float>(1 / metres_per_texel);
  levels_.push_back({image, texels_per_metre});
  while (image.cols > 1) {
    cv::Mat half;
    cv::resize(image, half, cv::Size(), 0.5, 0.5, cv::INTER_AREA);
    image = half;
    texels_per_metre *= 0.5F;
    levels_.push_back({image, texels_per_metre});
  }
}

Eigen::Array3f Texture::Sample(float u_m, float v_m, float footprint_m) const {
  const auto sample = [&](std::size_t k) {
    return SampleBilinear(levels_[k].image, u_m * levels_[k].texels_per_metre,
                          v_m * levels_[k].texels_per_metre);
  };
  const float texels = footprint_m * levels_.front().texels_per_metre;
  if (!(texels > 1)) return ToArray(sample(0));
  // The float's exponent is the finer level; its mantissa, the way to the coarser: log2 made
  // piecewise linear.
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(texels);
  const std::size_t fine = (bits >> 23) - 127;
  if (fine + 1 >= levels_.size()) return ToArray(sample(levels_.size() - 1));
  return ToArray(LerpPixel(sample(fine), sample(fine + 1), (bits >> 15) & 255));
}

}  // namespace ofm
