// Procedural surface textures, rich in corners at every scale.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "ofm/base/options.h"

namespace ofm {

/// What is painted on a surface.
enum class TextureStyle {
  kPatches,  ///< overlapping polygons of all sizes: corners for every pyramid level
  kChecker,  ///< a regular checker-board of 16 texels
  kNoise,    ///< smooth noise: few corners
};
EnumNameList<TextureStyle> EnumNames(TextureStyle);

struct TextureOptions {
  TextureStyle style = TextureStyle::kPatches;
  int size_px = 512;               ///< width and height of the tile, a power of two
  double metres_per_texel = 4e-3;  ///< [m]
  double contrast = 1;             ///< 0 = one colour, 1 = full range
};

/// A square tile that repeats over the whole plane, with a chain of halved images (a mip map;
/// Williams 1983) so that far surfaces do not alias. Immutable once made.
class Texture {
 public:
  /// The same (options, seed) give the same texture.
  Texture(const TextureOptions& options, std::uint64_t seed);

  /// A tile at hand: CV_8UC3, square, its size a power of two; column 0 is at u = 0, row 0 at v =
  /// 0.
  Texture(const cv::Mat& tile, double metres_per_texel);

  /// Colour (blue, green, red; 0 to 255) at the surface point (u, v) [m], averaged over about
  /// `footprint_m` [m]: bilinear in the plane, linear between levels.
  Eigen::Array3f Sample(float u_m, float v_m, float footprint_m) const;

  /// The full-size tile, CV_8UC4 (the fourth channel is unused).
  const cv::Mat& image() const { return levels_.front().image; }

 private:
  struct Level {
    cv::Mat image;           ///< CV_8UC4, continuous, half the size of the level before
    float texels_per_metre;  ///< of this level
  };

  std::vector<Level> levels_;
};

}  // namespace ofm
