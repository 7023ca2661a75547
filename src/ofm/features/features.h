// What the front end knows of an image: key points and binary descriptors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "ofm/features/image_patch.h"

namespace ofm {

/// 256 bits, compared by Hamming distance.
using Descriptor = std::array<std::uint64_t, 4>;

/// Number of bits that differ, 0 to 256.
inline int HammingDistance(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]) + std::popcount(a[2] ^ b[2]) +
         std::popcount(a[3] ^ b[3]);
}

/// A corner of the image pyramid, in the coordinates of the full image.
struct Keypoint {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  ///< where it was seen, distorted [px]
  int octave = 0;                                   ///< pyramid level, 0 = full size
  float angle_rad = 0;                              ///< of the intensity centroid, in [0, 2 pi)
  float response = 0;                               ///< corner score; larger is stronger
};

/// Key points with their descriptors and what is about them; all lists have the same length, but
/// that there may be no patches.
struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
  std::vector<ImagePatch> patches;

  std::size_t size() const { return keypoints.size(); }
};

}  // namespace ofm
