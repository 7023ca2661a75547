// The inner loops of ORB extraction, in a portable form and in AVX2, with equal results.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ofm/features/features.h"

namespace ofm {

/// Radius of the disc that gives a key point's orientation and descriptor [px of its level].
inline constexpr int kPatchRadius = 15;

/// Kernels may read and write this many bytes past the end of a row, and read as many before it;
/// what they write there has no meaning.
inline constexpr int kRowPadding = 64;

/// How eight neighbouring pixels of a resampled row are made of sixteen of its source row.
struct ResampleBlock {
  int first = 0;                          ///< column of the source that tap 0 stands for
  std::array<std::uint8_t, 16> taps{};    ///< two source columns for each pixel, from `first`
  std::array<std::int8_t, 16> weights{};  ///< theirs, adding up to kResampleOne
};
inline constexpr int kResampleOne = 64;

/// First moments of the intensities in a disc; the orientation is atan2(y, x).
struct CentroidMoments {
  int x = 0, y = 0;
  bool operator==(const CentroidMoments&) const = default;
};

/// Offsets of the two pixels of each BRIEF test in a PatchBuffer.
using RotatedPattern = std::array<std::array<std::uint16_t, 2>, 256>;
/// 31 rows of 32 bytes about a key point; the centre is at row and column kPatchRadius.
using PatchBuffer = std::array<std::uint8_t, 32 * (2 * kPatchRadius + 1)>;

/// Sums over the 7 x 7 pixels about a corner of the products of the Sobel gradients there (8 times
/// grey levels per pixel).
struct StructureTensor {
  int xx = 0, yy = 0, xy = 0;
  bool operator==(const StructureTensor&) const = default;
};

struct OrbKernels {
  /// 3 x 3 binomial smoothing of `n` pixels of a row; reads one pixel before and after.
  void (*smooth_row)(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below,
                     int n, std::uint8_t* out);
  /// FAST-9-16 scores (Rosten and Drummond, ECCV 2006) of `n` pixels from `row`: the largest
  /// difference d for which nine neighbours on the circle are all brighter by d or all darker by d,
  /// 0 where that is not over `threshold`. Reads 3 rows and columns about.
  void (*fast_scores)(const std::uint8_t* row, std::ptrdiff_t stride, int n, int threshold,
                      std::uint8_t* scores);
  /// Writes the columns of `n` scores that are not 0 and not under any of their eight neighbours
  /// (over those before them, so that one of equals remains); returns how many.
  int (*find_maxima)(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below,
                     int n, std::uint16_t* columns);
  StructureTensor (*structure_tensor)(const std::uint8_t* centre, std::ptrdiff_t stride);
  /// 7-tap Gaussian of sigma 2 down the columns of seven rows.
  void (*blur_columns)(const std::array<const std::uint8_t*, 7>& rows, int n, std::uint8_t* out);
  /// The same along a row; reads 3 pixels before and after.
  void (*blur_row)(const std::uint8_t* row, int n, std::uint8_t* out);
  /// Resamples a row to `blocks` * 8 values, times kResampleOne.
  void (*resample_row)(const std::uint8_t* row, const ResampleBlock* blocks, int count,
                       std::int16_t* out);
  /// (a * (2^15 - weight) + b * weight) / (2^15 * kResampleOne), rounded, of `n` values.
  void (*mix_rows)(const std::int16_t* a, const std::int16_t* b, int weight, int n,
                   std::uint8_t* out);
  /// Moments of the disc of kPatchRadius about `centre`.
  CentroidMoments (*centroid)(const std::uint8_t* centre, std::ptrdiff_t stride);
  /// Copies the 31 x 32 pixels about `centre`.
  void (*copy_patch)(const std::uint8_t* centre, std::ptrdiff_t stride, PatchBuffer& patch);
  /// Bit i: pixel 0 of test i is darker than pixel 1.
  Descriptor (*describe)(const PatchBuffer& patch, const RotatedPattern& pattern);
};

/// Runs everywhere.
const OrbKernels& PortableOrbKernels();
/// Null where the compiler or this processor has no AVX2.
const OrbKernels* Avx2OrbKernels();
/// The fastest that this processor runs. All give the same results.
const OrbKernels& BestOrbKernels();

}  // namespace ofm
