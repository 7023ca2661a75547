#include "ofm/features/orb_kernels.h"

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#include <immintrin.h>

#include <bit>

// Compiled for AVX2 function by function, so that the rest of the program runs on any x86-64.
#define OFM_AVX2 __attribute__((target("avx2")))

namespace ofm {
namespace {

OFM_AVX2 inline __m256i Load(const void* p) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}
OFM_AVX2 inline void Store(void* p, __m256i v) { _mm256_storeu_si256(static_cast<__m256i*>(p), v); }
OFM_AVX2 inline __m256i Min(__m256i a, __m256i b) { return _mm256_min_epu8(a, b); }
OFM_AVX2 inline __m256i Max(__m256i a, __m256i b) { return _mm256_max_epu8(a, b); }
OFM_AVX2 inline bool IsZero(__m256i v) { return _mm256_testz_si256(v, v) != 0; }

/// The largest difference that all of nine neighbours on the circle reach. Arcs that begin at
/// k - 1 and k (k even) share the eight from k.
OFM_AVX2 inline __m256i BestArc(const __m256i (&d)[16]) {
  __m256i two[8], four[8];
  for (int i = 0; i < 8; ++i) two[i] = Min(d[2 * i], d[2 * i + 1]);
  for (int i = 0; i < 8; ++i) four[i] = Min(two[i], two[(i + 1) & 7]);
  __m256i best = _mm256_setzero_si256();
  for (int i = 0; i < 8; ++i) {
    const __m256i eight = Min(four[i], four[(i + 2) & 7]);
    best = Max(best, Min(eight, Max(d[(2 * i + 8) & 15], d[(2 * i + 15) & 15])));
  }
  return best;
}

/// Not 0 where the four opposite pairs of the circle allow an arc over the threshold.
OFM_AVX2 inline __m256i MayBeCorner(const __m256i (&d)[16], __m256i threshold) {
  const __m256i a = Min(Max(d[0], d[8]), Max(d[4], d[12]));
  const __m256i b = Min(Max(d[2], d[10]), Max(d[6], d[14]));
  return _mm256_subs_epu8(Min(a, b), threshold);
}

OFM_AVX2 inline __m256i FastScore32(const std::uint8_t* p, const std::ptrdiff_t (&circle)[16],
                                    __m256i threshold) {
  const __m256i centre = Load(p);
  __m256i score = _mm256_setzero_si256();
  __m256i difference[16];
  for (int i = 0; i < 16; ++i) difference[i] = _mm256_subs_epu8(Load(p + circle[i]), centre);
  if (!IsZero(MayBeCorner(difference, threshold))) score = BestArc(difference);
  for (int i = 0; i < 16; ++i) difference[i] = _mm256_subs_epu8(centre, Load(p + circle[i]));
  if (!IsZero(MayBeCorner(difference, threshold))) score = Max(score, BestArc(difference));
  const __m256i is_under = _mm256_cmpeq_epi8(Max(score, threshold), threshold);
  return _mm256_andnot_si256(is_under, score);
}

OFM_AVX2 void FastScores(const std::uint8_t* row, std::ptrdiff_t stride, int n, int threshold,
                         std::uint8_t* scores) {
  const std::ptrdiff_t s = stride;
  const std::ptrdiff_t circle[16] = {-3 * s,    1 - 3 * s, 2 - 2 * s,  3 - s,     3,         3 + s,
                                     2 + 2 * s, 1 + 3 * s, 3 * s,      3 * s - 1, 2 * s - 2, s - 3,
                                     -3,        -3 - s,    -2 - 2 * s, -1 - 3 * s};
  const __m256i thresholds = _mm256_set1_epi8(static_cast<char>(threshold));
  for (int x = 0; x < n; x += 32) Store(scores + x, FastScore32(row + x, circle, thresholds));
}

OFM_AVX2 inline std::uint32_t MaximaMask(const std::uint8_t* above, const std::uint8_t* row,
                                         const std::uint8_t* below) {
  const __m256i score = Load(row);
  if (IsZero(score)) return 0;
  const __m256i before =
      Max(Max(Load(above - 1), Load(above)), Max(Load(above + 1), Load(row - 1)));
  const __m256i after = Max(Max(Load(below - 1), Load(below)), Max(Load(below + 1), Load(row + 1)));
  const __m256i is_not_over = _mm256_cmpeq_epi8(Max(score, before), before);
  const __m256i is_not_under = _mm256_cmpeq_epi8(Max(score, after), score);
  return static_cast<std::uint32_t>(
      _mm256_movemask_epi8(_mm256_andnot_si256(is_not_over, is_not_under)));
}

OFM_AVX2 int FindMaxima(const std::uint8_t* above, const std::uint8_t* row,
                        const std::uint8_t* below, int n, std::uint16_t* columns) {
  int count = 0;
  for (int x = 0; x < n; x += 32) {
    std::uint32_t mask = MaximaMask(above + x, row + x, below + x);
    if (n - x < 32) mask &= (1u << (n - x)) - 1;
    for (; mask != 0; mask &= mask - 1) {
      columns[count++] = static_cast<std::uint16_t>(x + std::countr_zero(mask));
    }
  }
  return count;
}

OFM_AVX2 inline __m256i Load16(const std::uint8_t* p) {
  return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)));
}
OFM_AVX2 inline __m256i Weigh121(__m256i a, __m256i b, __m256i c) {
  return _mm256_add_epi16(_mm256_add_epi16(a, c), _mm256_add_epi16(b, b));
}

OFM_AVX2 inline __m256i Smooth16(const std::uint8_t* above, const std::uint8_t* row,
                                 const std::uint8_t* below) {
  __m256i columns[3];
  for (int i = 0; i < 3; ++i) {
    columns[i] = Weigh121(Load16(above + i - 1), Load16(row + i - 1), Load16(below + i - 1));
  }
  const __m256i sum = Weigh121(columns[0], columns[1], columns[2]);
  return _mm256_srli_epi16(_mm256_add_epi16(sum, _mm256_set1_epi16(8)), 4);
}

OFM_AVX2 void SmoothRow(const std::uint8_t* above, const std::uint8_t* row,
                        const std::uint8_t* below, int n, std::uint8_t* out) {
  for (int x = 0; x < n; x += 32) {
    const __m256i packed =
        _mm256_packus_epi16(Smooth16(above + x, row + x, below + x),
                            Smooth16(above + x + 16, row + x + 16, below + x + 16));
    Store(out + x, _mm256_permute4x64_epi64(packed, 0xd8));
  }
}

OFM_AVX2 inline __m128i Load8(const std::uint8_t* p) {
  return _mm_cvtepu8_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
}
OFM_AVX2 inline int SumOf32Bit(__m128i v) {
  const __m128i two = _mm_add_epi32(v, _mm_shuffle_epi32(v, 0x4e));
  return _mm_cvtsi128_si32(_mm_add_epi32(two, _mm_shuffle_epi32(two, 0xb1)));
}

OFM_AVX2 StructureTensor TensorOf(const std::uint8_t* centre, std::ptrdiff_t stride) {
  // Of each row: the difference and the 1 2 1 sum of its left, middle and right neighbours.
  __m128i difference[9], sum[9];
  for (int i = 0; i < 9; ++i) {
    const std::uint8_t* p = centre + (i - 4) * stride - 3;
    const __m128i left = Load8(p - 1), middle = Load8(p), right = Load8(p + 1);
    difference[i] = _mm_sub_epi16(right, left);
    sum[i] = _mm_add_epi16(_mm_add_epi16(left, right), _mm_add_epi16(middle, middle));
  }
  const __m128i seven = _mm_setr_epi16(-1, -1, -1, -1, -1, -1, -1, 0);
  __m128i xx = _mm_setzero_si128(), yy = xx, xy = xx;
  for (int i = 1; i < 8; ++i) {
    const __m128i twice = _mm_add_epi16(difference[i], difference[i]);
    const __m128i both = _mm_add_epi16(difference[i - 1], difference[i + 1]);
    const __m128i dx = _mm_and_si128(_mm_add_epi16(twice, both), seven);
    const __m128i dy = _mm_and_si128(_mm_sub_epi16(sum[i + 1], sum[i - 1]), seven);
    xx = _mm_add_epi32(xx, _mm_madd_epi16(dx, dx));
    yy = _mm_add_epi32(yy, _mm_madd_epi16(dy, dy));
    xy = _mm_add_epi32(xy, _mm_madd_epi16(dx, dy));
  }
  return {SumOf32Bit(xx), SumOf32Bit(yy), SumOf32Bit(xy)};
}

/// a * weights[even] + b * weights[odd] of 32 pixels as 16-bit sums, in the order of unpacking.
struct Sums {
  __m256i low, high;
};
OFM_AVX2 inline void AddWeighted(Sums& sums, __m256i a, __m256i b, __m256i weights) {
  sums.low = _mm256_add_epi16(sums.low, _mm256_maddubs_epi16(_mm256_unpacklo_epi8(a, b), weights));
  sums.high =
      _mm256_add_epi16(sums.high, _mm256_maddubs_epi16(_mm256_unpackhi_epi8(a, b), weights));
}

/// The seven taps 9 17 24 28 24 17 9 / 128; the sums stay under 2^15.
OFM_AVX2 inline __m256i Blur32(const __m256i (&taps)[7]) {
  const __m256i outer = _mm256_set1_epi16(9 + 256 * 17), inner = _mm256_set1_epi16(24 + 256 * 28);
  const __m256i inner_mirrored = _mm256_set1_epi16(24 + 256 * 17), last = _mm256_set1_epi16(9);
  const __m256i half = _mm256_set1_epi16(64);
  Sums sums{half, half};
  AddWeighted(sums, taps[0], taps[1], outer);
  AddWeighted(sums, taps[2], taps[3], inner);
  AddWeighted(sums, taps[4], taps[5], inner_mirrored);
  AddWeighted(sums, taps[6], _mm256_setzero_si256(), last);
  return _mm256_packus_epi16(_mm256_srli_epi16(sums.low, 7), _mm256_srli_epi16(sums.high, 7));
}

OFM_AVX2 void BlurColumns(const std::array<const std::uint8_t*, 7>& rows, int n,
                          std::uint8_t* out) {
  for (int x = 0; x < n; x += 32) {
    __m256i taps[7];
    for (int i = 0; i < 7; ++i) taps[i] = Load(rows[i] + x);
    Store(out + x, Blur32(taps));
  }
}

OFM_AVX2 void BlurRow(const std::uint8_t* row, int n, std::uint8_t* out) {
  for (int x = 0; x < n; x += 32) {
    __m256i taps[7];
    for (int i = 0; i < 7; ++i) taps[i] = Load(row + x + i - 3);
    Store(out + x, Blur32(taps));
  }
}

OFM_AVX2 void ResampleRow(const std::uint8_t* row, const ResampleBlock* blocks, int count,
                          std::int16_t* out) {
  for (int i = 0; i < count; ++i, out += 8) {
    const auto load = [](const void* p) __attribute__((target("avx2"))) {
      return _mm_loadu_si128(static_cast<const __m128i*>(p));
    };
    const __m128i taps = _mm_shuffle_epi8(load(row + blocks[i].first), load(blocks[i].taps.data()));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out),
                     _mm_maddubs_epi16(taps, load(blocks[i].weights.data())));
  }
}

OFM_AVX2 inline __m256i Mix16(const std::int16_t* a, const std::int16_t* b, __m256i weight) {
  const __m256i from = Load(a);
  const __m256i step = _mm256_mulhrs_epi16(_mm256_sub_epi16(Load(b), from), weight);
  const __m256i half = _mm256_set1_epi16(kResampleOne / 2);
  static_assert(kResampleOne == 64);
  return _mm256_srli_epi16(_mm256_add_epi16(_mm256_add_epi16(from, step), half), 6);
}

OFM_AVX2 void MixRows(const std::int16_t* a, const std::int16_t* b, int weight, int n,
                      std::uint8_t* out) {
  const __m256i weights = _mm256_set1_epi16(static_cast<std::int16_t>(weight));
  for (int x = 0; x < n; x += 32) {
    const __m256i packed =
        _mm256_packus_epi16(Mix16(a + x, b + x, weights), Mix16(a + x + 16, b + x + 16, weights));
    Store(out + x, _mm256_permute4x64_epi64(packed, 0xd8));
  }
}

/// Rows -15..15 of the disc: which of the 32 bytes from column -15 belong to it.
struct DiscMasks {
  alignas(32) std::uint8_t mask[2 * kPatchRadius + 1][32] = {};
  alignas(32) std::int8_t column[32] = {};
};
constexpr DiscMasks MakeDiscMasks() {
  DiscMasks disc;
  for (int i = 0; i < 32; ++i) disc.column[i] = static_cast<std::int8_t>(i - kPatchRadius);
  for (int y = 0; y <= 2 * kPatchRadius; ++y) {
    for (int x = 0; x <= 2 * kPatchRadius; ++x) {
      const int dx = x - kPatchRadius, dy = y - kPatchRadius;
      disc.mask[y][x] = dx * dx + dy * dy <= kPatchRadius * kPatchRadius ? 255 : 0;
    }
  }
  return disc;
}
constexpr DiscMasks kDisc = MakeDiscMasks();

OFM_AVX2 inline int SumOf32Bit(__m256i v) {
  return SumOf32Bit(_mm_add_epi32(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1)));
}

OFM_AVX2 CentroidMoments Centroid(const std::uint8_t* centre, std::ptrdiff_t stride) {
  const __m256i zero = _mm256_setzero_si256(), ones = _mm256_set1_epi16(1);
  const __m256i column = Load(kDisc.column);
  __m256i x_moment = zero, y_moment = zero;
  for (int row = 0; row <= 2 * kPatchRadius; ++row) {
    const int dy = row - kPatchRadius;
    const __m256i pixels =
        _mm256_and_si256(Load(centre + dy * stride - kPatchRadius), Load(kDisc.mask[row]));
    const __m256i products = _mm256_maddubs_epi16(pixels, column);
    x_moment = _mm256_add_epi32(x_moment, _mm256_madd_epi16(products, ones));
    const __m256i sums = _mm256_sad_epu8(pixels, zero);
    y_moment = _mm256_add_epi32(y_moment, _mm256_mullo_epi32(sums, _mm256_set1_epi32(dy)));
  }
  return {SumOf32Bit(x_moment), SumOf32Bit(y_moment)};
}

OFM_AVX2 void CopyPatch(const std::uint8_t* centre, std::ptrdiff_t stride, PatchBuffer& patch) {
  const std::uint8_t* source = centre - kPatchRadius * stride - kPatchRadius;
  for (int row = 0; row <= 2 * kPatchRadius; ++row) {
    Store(&patch[32 * row], Load(source + row * stride));
  }
}

}  // namespace

const OrbKernels* Avx2OrbKernels() {
  static const OrbKernels kKernels = [] {
    OrbKernels kernels = PortableOrbKernels();  // `describe` is scattered loads: nothing to gain
    kernels.smooth_row = SmoothRow;
    kernels.fast_scores = FastScores;
    kernels.structure_tensor = TensorOf;
    kernels.find_maxima = FindMaxima;
    kernels.blur_columns = BlurColumns;
    kernels.blur_row = BlurRow;
    kernels.resample_row = ResampleRow;
    kernels.mix_rows = MixRows;
    kernels.centroid = Centroid;
    kernels.copy_patch = CopyPatch;
    return kernels;
  }();
  return __builtin_cpu_supports("avx2") ? &kKernels : nullptr;
}

}  // namespace ofm

#else

namespace ofm {
const OrbKernels* Avx2OrbKernels() { return nullptr; }
}  // namespace ofm

#endif
