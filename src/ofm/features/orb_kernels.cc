#include "ofm/features/orb_kernels.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace ofm {
namespace {

/// Offsets (x, y) of the circle of radius 3, in order.
constexpr int kCircle[16][2] = {{0, -3}, {1, -3},  {2, -2},  {3, -1}, {3, 0},  {3, 1},
                                {2, 2},  {1, 3},   {0, 3},   {-1, 3}, {-2, 2}, {-3, 1},
                                {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};

/// The largest difference that all of nine neighbours on the circle reach. Arcs that begin at k - 1
/// and k (k even) share the eight from k.
int BestArc(const std::array<int, 16>& difference) {
  std::array<int, 8> two, four;
  for (int i = 0; i < 8; ++i) two[i] = std::min(difference[2 * i], difference[2 * i + 1]);
  for (int i = 0; i < 8; ++i) four[i] = std::min(two[i], two[(i + 1) & 7]);
  int best = 0;
  for (int i = 0; i < 8; ++i) {
    const int ends = std::max(difference[(2 * i + 8) & 15], difference[(2 * i + 15) & 15]);
    best = std::max(best, std::min({four[i], four[(i + 2) & 7], ends}));
  }
  return best;
}

int FastScore(const std::uint8_t* centre, const std::array<std::ptrdiff_t, 16>& circle,
              int threshold) {
  // An arc of nine holds one of each two opposite pixels.
  const int bright = *centre + threshold, dark = *centre - threshold;
  bool may_be_brighter = true, may_be_darker = true;
  for (int i = 0; i < 8; ++i) {
    const int a = centre[circle[i]], b = centre[circle[i + 8]];
    may_be_brighter = may_be_brighter && std::max(a, b) > bright;
    may_be_darker = may_be_darker && std::min(a, b) < dark;
    if (!may_be_brighter && !may_be_darker) return 0;
  }
  int score = 0;
  std::array<int, 16> difference;
  for (const int sign : {1, -1}) {
    if (!(sign > 0 ? may_be_brighter : may_be_darker)) continue;
    for (int i = 0; i < 16; ++i) difference[i] = sign * (centre[circle[i]] - *centre);
    score = std::max(score, BestArc(difference));
  }
  return score > threshold ? score : 0;
}

void FastScores(const std::uint8_t* row, std::ptrdiff_t stride, int n, int threshold,
                std::uint8_t* scores) {
  std::array<std::ptrdiff_t, 16> circle;
  for (int i = 0; i < 16; ++i) circle[i] = kCircle[i][0] + kCircle[i][1] * stride;
  for (int x = 0; x < n; ++x) {
    scores[x] = static_cast<std::uint8_t>(FastScore(row + x, circle, threshold));
  }
}

int FindMaxima(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below, int n,
               std::uint16_t* columns) {
  int count = 0;
  for (int x = 0; x < n; ++x) {
    const int score = row[x];
    if (score == 0) continue;
    const int before = std::max({above[x - 1], above[x], above[x + 1], row[x - 1]});
    const int after = std::max({row[x + 1], below[x - 1], below[x], below[x + 1]});
    if (score > before && score >= after) columns[count++] = static_cast<std::uint16_t>(x);
  }
  return count;
}

void SmoothRow(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* below, int n,
               std::uint8_t* out) {
  const auto column = [&](int x) { return above[x] + 2 * row[x] + below[x]; };
  for (int x = 0; x < n; ++x) {
    const int sum = column(x - 1) + 2 * column(x) + column(x + 1);
    out[x] = static_cast<std::uint8_t>((sum + 8) >> 4);
  }
}

StructureTensor TensorOf(const std::uint8_t* centre, std::ptrdiff_t stride) {
  StructureTensor tensor;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      const std::uint8_t* p = centre + y * stride + x;
      const std::uint8_t *above = p - stride, *below = p + stride;
      const int dx = above[1] - above[-1] + 2 * (p[1] - p[-1]) + below[1] - below[-1];
      const int dy = below[-1] - above[-1] + 2 * (below[0] - above[0]) + below[1] - above[1];
      tensor.xx += dx * dx;
      tensor.yy += dy * dy;
      tensor.xy += dx * dy;
    }
  }
  return tensor;
}

// exp(-i^2 / (2 * 2^2)) for i = 0..3, normalised to a sum of 128 over the seven taps.
constexpr int kBlur[4] = {28, 24, 17, 9};

std::uint8_t BlurTaps(int centre, int pair1, int pair2, int pair3) {
  const int sum = kBlur[0] * centre + kBlur[1] * pair1 + kBlur[2] * pair2 + kBlur[3] * pair3;
  return static_cast<std::uint8_t>((sum + 64) >> 7);
}

void BlurColumns(const std::array<const std::uint8_t*, 7>& rows, int n, std::uint8_t* out) {
  for (int x = 0; x < n; ++x) {
    out[x] = BlurTaps(rows[3][x], rows[2][x] + rows[4][x], rows[1][x] + rows[5][x],
                      rows[0][x] + rows[6][x]);
  }
}

void BlurRow(const std::uint8_t* row, int n, std::uint8_t* out) {
  for (int x = 0; x < n; ++x) {
    const std::uint8_t* p = row + x;
    out[x] = BlurTaps(p[0], p[-1] + p[1], p[-2] + p[2], p[-3] + p[3]);
  }
}

void ResampleRow(const std::uint8_t* row, const ResampleBlock* blocks, int count,
                 std::int16_t* out) {
  for (int b = 0; b < count; ++b) {
    const ResampleBlock& block = blocks[b];
    const std::uint8_t* source = row + block.first;
    for (int i = 0; i < 8; ++i) {
      *out++ = static_cast<std::int16_t>(source[block.taps[2 * i]] * block.weights[2 * i] +
                                         source[block.taps[2 * i + 1]] * block.weights[2 * i + 1]);
    }
  }
}

void MixRows(const std::int16_t* a, const std::int16_t* b, int weight, int n, std::uint8_t* out) {
  for (int x = 0; x < n; ++x) {
    const int mixed = a[x] + (((b[x] - a[x]) * weight + 0x4000) >> 15);
    out[x] = static_cast<std::uint8_t>((mixed + kResampleOne / 2) / kResampleOne);
  }
}

/// Half the width of the disc at each distance from its middle row.
constexpr auto kDiscHalfWidths = [] {
  std::array<int, kPatchRadius + 1> widths{};
  for (int dy = 0; dy <= kPatchRadius; ++dy) {
    while ((widths[dy] + 1) * (widths[dy] + 1) + dy * dy <= kPatchRadius * kPatchRadius) {
      ++widths[dy];
    }
  }
  return widths;
}();

CentroidMoments Centroid(const std::uint8_t* centre, std::ptrdiff_t stride) {
  CentroidMoments moments;
  for (int dy = -kPatchRadius; dy <= kPatchRadius; ++dy) {
    const std::uint8_t* row = centre + dy * stride;
    const int half_width = kDiscHalfWidths[std::abs(dy)];
    int sum = 0;
    for (int dx = -half_width; dx <= half_width; ++dx) {
      sum += row[dx];
      moments.x += dx * row[dx];
    }
    moments.y += dy * sum;
  }
  return moments;
}

void CopyPatch(const std::uint8_t* centre, std::ptrdiff_t stride, PatchBuffer& patch) {
  for (int dy = 0; dy <= 2 * kPatchRadius; ++dy) {
    std::memcpy(&patch[32 * dy], centre + (dy - kPatchRadius) * stride - kPatchRadius, 32);
  }
}

Descriptor Describe(const PatchBuffer& patch, const RotatedPattern& pattern) {
  Descriptor descriptor;
  const std::uint8_t* pixels = patch.data();
  for (int word = 0; word < 4; ++word) {
    std::uint64_t bits = 0;
    const auto* tests = &pattern[64 * word];
    for (int i = 63; i >= 0; --i) {
      bits = 2 * bits + (pixels[tests[i][0]] < pixels[tests[i][1]] ? 1 : 0);
    }
    descriptor[word] = bits;
  }
  return descriptor;
}

}  // namespace

const OrbKernels& PortableOrbKernels() {
  static constexpr OrbKernels kKernels = {.smooth_row = SmoothRow,
                                          .fast_scores = FastScores,
                                          .find_maxima = FindMaxima,
                                          .structure_tensor = TensorOf,
                                          .blur_columns = BlurColumns,
                                          .blur_row = BlurRow,
                                          .resample_row = ResampleRow,
                                          .mix_rows = MixRows,
                                          .centroid = Centroid,
                                          .copy_patch = CopyPatch,
                                          .describe = Describe};
  return kKernels;
}

const OrbKernels& BestOrbKernels() {
  const OrbKernels* avx2 = Avx2OrbKernels();
  return avx2 ? *avx2 : PortableOrbKernels();
}

}  // namespace ofm
