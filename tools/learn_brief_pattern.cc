// Learns the 256 tests of the binary descriptor and prints src/ofm/features/brief_pattern.cc:
//   build/release/bin/ofm_learn_brief_pattern IMAGE... > src/ofm/features/brief_pattern.cc
//
// As in Rublee et al., "ORB" (ICCV 2011), section 4.3: a greedy choice among many tests, best
// first, of those that correlate little with the ones chosen. "Best" differs from that paper: each
// key point is also seen in warped, noisy views of its image, and a test is good where it tells
// key points apart (its bit is 1 for about half of them) and keeps its bit between views.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/random.h"
#include "ofm/features/brief_pattern.h"
#include "ofm/features/orb_extractor.h"

namespace ofm {
namespace {

constexpr int kCandidates = 60000;
constexpr int kMaxPointsPerImage = 500;

using Bits = std::vector<std::uint64_t>;

/// Smoothed patches of the same point in two views, each turned by its own orientation.
struct PatchPair {
  std::array<std::uint8_t, 31 * 31> first, second;
};

struct Candidate {
  BriefTest test;
  double quality = 0;  ///< larger is better
  Bits bits;           ///< of the first views
  int ones = 0;
};

double Gaussian(RandomEngine& engine) {
  const double radius = std::sqrt(-2 * std::log(1 - UniformReal(engine)));
  return radius * std::cos(2 * std::numbers::pi * UniformReal(engine));
}

/// A homography near a rotation and scaling about the image's centre.
cv::Matx33d RandomView(RandomEngine& engine, cv::Size size) {
  const double angle = 0.5 * Gaussian(engine), scale = std::exp(0.12 * Gaussian(engine));
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  const cv::Matx33d centre(1, 0, -size.width / 2.0, 0, 1, -size.height / 2.0, 0, 0, 1);
  const auto small = [&](double sigma) { return sigma * Gaussian(engine); };
  const cv::Matx33d warp(c + small(0.06), -s + small(0.06), 0, s + small(0.06), c + small(0.06), 0,
                         small(2e-4), small(2e-4), 1);
  return centre.inv() * warp * centre;
}

cv::Mat SeenFrom(const cv::Mat& image, const cv::Matx33d& view, RandomEngine& engine) {
  cv::Mat seen;
  cv::warpPerspective(image, seen, view, image.size(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  if (UniformIndex(engine, 2) == 0) cv::GaussianBlur(seen, seen, {}, 0.5 + UniformReal(engine));
  const double gain = std::exp(0.15 * Gaussian(engine)), offset = 8 * Gaussian(engine);
  for (int y = 0; y < seen.rows; ++y) {
    for (int x = 0; x < seen.cols; ++x) {
      std::uint8_t& value = seen.at<std::uint8_t>(y, x);
      value = cv::saturate_cast<std::uint8_t>(gain * value + offset + 3 * Gaussian(engine));
    }
  }
  return seen;
}

/// Turned back by the key point's orientation and brought to its octave's scale.
std::array<std::uint8_t, 31 * 31> PatchOf(const cv::Mat& image, const Keypoint& keypoint,
                                          double scale) {
  cv::Mat smooth;
  const double c = scale * std::cos(keypoint.angle_rad), s = scale * std::sin(keypoint.angle_rad);
  // 6 pixels more on each side: the smoothing needs neighbours.
  constexpr double kCentre = kPatchRadius + 6;
  const double x = keypoint.pixel.x(), y = keypoint.pixel.y();
  const cv::Matx23d from_patch(c, -s, x - c * kCentre + s * kCentre, s, c,
                               y - s * kCentre - c * kCentre);
  cv::warpAffine(image, smooth, from_patch, {43, 43}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  cv::GaussianBlur(smooth, smooth, {7, 7}, 2);
  std::array<std::uint8_t, 31 * 31> patch;
  for (int row = 0; row < 31; ++row) std::copy_n(smooth.ptr(row + 6) + 6, 31, &patch[31 * row]);
  return patch;
}

/// Pairs of the key points of `image` that a second view has again.
void AddPairs(const cv::Mat& image, RandomEngine& engine, std::vector<PatchPair>& pairs) {
  OrbOptions options;
  options.count = kMaxPointsPerImage;
  OrbExtractor extractor(options);
  const cv::Matx33d view = RandomView(engine, image.size());
  const cv::Mat seen = SeenFrom(image, view, engine);
  const Features a = extractor.Extract(image), b = extractor.Extract(seen);
  for (const Keypoint& p : a.keypoints) {
    const cv::Vec3d place = view * cv::Vec3d(p.pixel.x(), p.pixel.y(), 1);
    const Eigen::Vector2f expected(static_cast<float>(place[0] / place[2]),
                                   static_cast<float>(place[1] / place[2]));
    const double scale = extractor.ScaleOf(p.octave);
    const Keypoint* nearest = nullptr;
    for (const Keypoint& q : b.keypoints) {
      if (std::abs(q.octave - p.octave) > 1) continue;
      if ((q.pixel - expected).norm() > 1.5 * scale) continue;
      if (!nearest || (q.pixel - expected).norm() < (nearest->pixel - expected).norm()) {
        nearest = &q;
      }
    }
    if (nearest) {
      pairs.push_back(
          {PatchOf(image, p, scale), PatchOf(seen, *nearest, extractor.ScaleOf(nearest->octave))});
    }
  }
}

BriefTest RandomTest(RandomEngine& engine) {
  const auto point = [&](std::int8_t& x, std::int8_t& y) {
    do {
      x = static_cast<std::int8_t>(UniformIndex(engine, 31)) - kPatchRadius;
      y = static_cast<std::int8_t>(UniformIndex(engine, 31)) - kPatchRadius;
    } while (x * x + y * y > kPatchRadius * kPatchRadius);
  };
  BriefTest test;
  do {
    point(test.x0, test.y0);
    point(test.x1, test.y1);
  } while (std::abs(test.x0 - test.x1) + std::abs(test.y0 - test.y1) < 3);
  return test;
}

Bits BitsOf(const std::vector<PatchPair>& pairs, const BriefTest& test,
            std::array<std::uint8_t, 31 * 31> PatchPair::*view) {
  const auto at = [](int x, int y) { return (y + kPatchRadius) * 31 + x + kPatchRadius; };
  const int first = at(test.x0, test.y0), second = at(test.x1, test.y1);
  Bits bits((pairs.size() + 63) / 64, 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& patch = pairs[i].*view;
    if (patch[first] < patch[second]) bits[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  return bits;
}

__attribute__((target("popcnt"))) int CountDifferent(const Bits& a, const Bits& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += __builtin_popcountll(a[i] ^ b[i]);
  return count;
}

Candidate Evaluate(const std::vector<PatchPair>& pairs, const BriefTest& test) {
  Candidate candidate{test, 0, BitsOf(pairs, test, &PatchPair::first), 0};
  candidate.ones = CountDifferent(candidate.bits, Bits(candidate.bits.size(), 0));
  const double n = static_cast<double>(pairs.size());
  const double flips = CountDifferent(candidate.bits, BitsOf(pairs, test, &PatchPair::second)) / n;
  const double ones = candidate.ones / n;
  // Difference between key points less difference between views of one, over the spread of both.
  const double other = 2 * ones * (1 - ones);
  candidate.quality =
      (other - flips) / std::sqrt(0.5 * (other * (1 - other) + flips * (1 - flips)) + 1e-9);
  return candidate;
}

/// Magnitude of the correlation of two tests' bits.
double Correlation(const Candidate& a, const Candidate& b, double n) {
  const double both = (a.ones + b.ones - CountDifferent(a.bits, b.bits)) / (2 * n);
  const double p = a.ones / n, q = b.ones / n;
  return std::abs(both - p * q) / std::sqrt(p * (1 - p) * q * (1 - q));
}

std::vector<const Candidate*> ChooseGreedily(const std::vector<Candidate>& candidates, double n) {
  for (double limit = 0.1;; limit += 0.02) {
    std::vector<const Candidate*> chosen;
    for (const Candidate& candidate : candidates) {
      const bool is_new = std::ranges::none_of(chosen, [&](const Candidate* other) {
        return Correlation(candidate, *other, n) > limit;
      });
      if (is_new) chosen.push_back(&candidate);
      if (chosen.size() == 256) {
        fmt::print(stderr, "largest correlation {:.2f}, quality {:.3f} to {:.3f}\n", limit,
                   chosen.front()->quality, chosen.back()->quality);
        return chosen;
      }
    }
  }
}

void PrintPattern(const std::vector<const Candidate*>& chosen) {
  fmt::print(
      "#include \"ofm/features/brief_pattern.h\"\n\nnamespace ofm {{\n\n// Made by "
      "tools/learn_brief_pattern.cc.\n// clang-format off\n"
      "const std::array<BriefTest, 256> kBriefPattern = {{{{\n");
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const BriefTest& t = chosen[i]->test;
    fmt::print("{}{{{}, {}, {}, {}}},{}", i % 4 == 0 ? "    " : " ", t.x0, t.y0, t.x1, t.y1,
               i % 4 == 3 ? "\n" : "");
  }
  fmt::print("}}}};\n// clang-format on\n\n}}  // namespace ofm\n");
}

int Main(int argc, char** argv) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  std::vector<PatchPair> pairs;
  for (int i = 1; i < argc; ++i) {
    const cv::Mat image = cv::imread(argv[i], cv::IMREAD_GRAYSCALE);
    if (image.empty()) {
      fmt::print(stderr, "{}: cannot be read\n", argv[i]);
      return 1;
    }
    AddPairs(image, engine, pairs);
  }
  if (pairs.size() < 1000) {
    fmt::print(stderr, "too few key points: give more images\n");
    return 1;
  }
  fmt::print(stderr, "{} pairs of patches\n", pairs.size());
  std::vector<Candidate> candidates;
  for (int i = 0; i < kCandidates; ++i) candidates.push_back(Evaluate(pairs, RandomTest(engine)));
  std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::quality);
  PrintPattern(ChooseGreedily(candidates, static_cast<double>(pairs.size())));
  return 0;
}

}  // namespace
}  // namespace ofm

int main(int argc, char** argv) { return ofm::Main(argc, argv); }
