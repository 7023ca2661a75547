#include "ofm/features/patch_alignment.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace ofm {
namespace {

constexpr int kWindowRadius = 4;  ///< of what is compared [px of the octave]
constexpr int kSide = 2 * kWindowRadius + 1;
constexpr int kPixels = kSide * kSide;
constexpr int kMaxIterations = 12;
constexpr float kConverged_px = 0.01F;

using Window = Eigen::Matrix<float, kPixels, 1>;

/// What the current patch is to show, and how that changes.
struct Template {
  Window gray;
  /// By the displacement in x and y [1/px], a bias and a gain.
  Eigen::Matrix<float, kPixels, 4> jacobian;
};

/// The reference's surroundings as the current view shows them; empty where the patch ends.
std::optional<Template> MakeTemplate(const PatchPlace& reference,
                                     const Eigen::Matrix2f& reference_from_current) {
  constexpr int kOuter = kWindowRadius + 1;  // derivatives need one more
  std::array<std::array<float, kSide + 2>, kSide + 2> warped{};
  for (int y = -kOuter; y <= kOuter; ++y) {
    for (int x = -kOuter; x <= kOuter; ++x) {
      if (std::abs(x) == kOuter && std::abs(y) == kOuter) continue;
      const float gray = reference.patch.At(
          reference.offset +
          reference_from_current * Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y)));
      if (gray < 0) return {};
      warped[y + kOuter][x + kOuter] = gray;
    }
  }
  Template made;
  for (int y = 0, k = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x, ++k) {
      made.gray[k] = warped[y + 1][x + 1];
      made.jacobian(k, 0) = (warped[y + 1][x + 2] - warped[y + 1][x]) / 2;
      made.jacobian(k, 1) = (warped[y + 2][x + 1] - warped[y][x + 1]) / 2;
    }
  }
  made.jacobian.col(2).setOnes();
  made.jacobian.col(3) = made.gray.array() - made.gray.mean();
  return made;
}

/// Whether the grey levels change in all directions: the lesser eigenvalue of their structure
/// tensor (Shi and Tomasi, CVPR 1994).
bool ShowsCorner(const Template& expected) {
  constexpr float kLeastGradient = 1;  // root mean square [grey levels / px]
  const Eigen::Matrix2f tensor =
      expected.jacobian.leftCols<2>().transpose() * expected.jacobian.leftCols<2>();
  const float half_trace = tensor.trace() / 2, half_difference = (tensor(0, 0) - tensor(1, 1)) / 2;
  const float lesser = half_trace - std::hypot(half_difference, tensor(0, 1));
  return lesser >= kPixels * kLeastGradient * kLeastGradient;
}

/// The window about `offset`; empty where the patch ends.
std::optional<Window> CutWindow(const ImagePatch& patch, const Eigen::Vector2f& offset) {
  const Eigen::Vector2f corner = offset.array() + (ImagePatch::kRadius - kWindowRadius);
  const float left = std::floor(corner.x()), top = std::floor(corner.y());
  constexpr float kLast = ImagePatch::kSize - kSide - 1;
  if (!(left >= 0 && top >= 0 && left <= kLast && top <= kLast)) return {};
  const float u = corner.x() - left, v = corner.y() - top;
  const std::uint8_t* row =
      patch.gray.data() + static_cast<int>(top) * ImagePatch::kSize + static_cast<int>(left);
  std::array<std::array<float, kSide>, kSide + 1> across;
  for (int y = 0; y <= kSide; ++y, row += ImagePatch::kSize) {
    for (int x = 0; x < kSide; ++x) across[y][x] = (1 - u) * row[x] + u * row[x + 1];
  }
  Window window;
  for (int y = 0, k = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x, ++k) {
      window[k] = (1 - v) * across[y][x] + v * across[y + 1][x];
    }
  }
  return window;
}

float Correlation(const Window& a, const Window& b) {
  const Window from_mean_a = a.array() - a.mean(), from_mean_b = b.array() - b.mean();
  const float norms = from_mean_a.norm() * from_mean_b.norm();
  return norms > 0 ? from_mean_a.dot(from_mean_b) / norms : 0;
}

}  // namespace

std::optional<Eigen::Vector2f> AlignPatch(const PatchPlace& reference, const PatchPlace& current,
                                          const Eigen::Matrix2f& reference_from_current,
                                          const PatchAlignmentOptions& options) {
  if (!reference.patch.is_whole || !current.patch.is_whole) return {};
  const auto expected = MakeTemplate(reference, reference_from_current);
  if (!expected || !ShowsCorner(*expected)) return {};
  const Eigen::Matrix4f information = expected->jacobian.transpose() * expected->jacobian;
  const Eigen::LDLT<Eigen::Matrix4f> solver(information);
  if (solver.info() != Eigen::Success) return {};
  Eigen::Vector2f offset = current.offset;
  for (int i = 0; i < kMaxIterations; ++i) {
    const auto seen = CutWindow(current.patch, offset);
    if (!seen) return {};
    const Eigen::Vector4f change =
        solver.solve(expected->jacobian.transpose() * (*seen - expected->gray));
    offset -= change.head<2>();
    if (!((offset - current.offset).norm() <= options.max_shift_px)) return {};
    if (change.head<2>().norm() > kConverged_px) continue;
    return Correlation(*seen, expected->gray) >= options.min_correlation ? std::optional(offset)
                                                                         : std::nullopt;
  }
  return {};
}

}  // namespace ofm
