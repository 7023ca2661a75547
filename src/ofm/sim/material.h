// What the things of a furnished world are made of, as procedural textures.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "ofm/sim/texture.h"

namespace ofm {

enum class Material {
  kPlaster,    ///< painted wall: faint stains and specks
  kCarpet,     ///< pile with blotches
  kParquet,    ///< planks with grain
  kTiles,      ///< square floor tiles with joints
  kCeiling,    ///< panels of 0.6 m with holes
  kWood,       ///< veneer, its grain along u
  kPlain,      ///< paint, plastic or metal: nearly one colour
  kCloth,      ///< weave
  kStripes,    ///< a striped shirt
  kPlaid,      ///< a plaid shirt
  kSpines,     ///< strips of 32 mm along v, each a book's colour with a title
  kCardboard,  ///< with tape and print
  kLeaves,     ///< foliage
  kSkin,
  kHair,
};

/// A tile that repeats. `bgr` is its main colour, which spines do without. The same arguments give
/// the same texture.
Texture MakeMaterial(Material material, const cv::Scalar& bgr, std::uint64_t seed);

}  // namespace ofm
