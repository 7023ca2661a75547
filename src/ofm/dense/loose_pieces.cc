#include "ofm/dense/loose_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "ofm/camera/depth_noise.h"
#include "ofm/camera/depth_regions.h"

namespace ofm {
namespace {

const cv::Point kSides[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

bool IsInside(const cv::Mat& image, cv::Point pixel) {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < image.cols && pixel.y < image.rows;
}

bool IsMasked(const PieceView& view, cv::Point pixel) {
  return view.dynamic.ptr<std::uint8_t>(pixel.y)[pixel.x] != 0;
}

float DepthAt(const PieceView& view, cv::Point pixel) {
  return view.depth_m.ptr<float>(pixel.y)[pixel.x];
}

/// No depth edge lies between them.
bool IsSmooth(float here_m, float there_m, const KeyframeCloudOptions& options) {
  return std::abs(there_m - here_m) <= options.edge_sigmas * DepthSigma(std::min(here_m, there_m));
}

/// Whether the pixel `other` beside a piece's `pixel` is of the piece too.
bool IsSameSurface(const PieceView& view, cv::Point pixel, cv::Point other,
                   const KeyframeCloudOptions& options) {
  if (!IsInside(view.depth_m, other) || IsMasked(view, other)) return false;
  return DepthAt(view, other) > 0 && IsSmooth(DepthAt(view, pixel), DepthAt(view, other), options);
}

/// Whether a surface goes on beyond its outline at `pixel`, for all that can be told.
bool IsCut(const PieceView& view, cv::Point pixel, cv::Point side,
           const KeyframeCloudOptions& options) {
  const int reach = view.depth_m.cols / 8;  // across a structured-light camera's shadow
  cv::Point beyond = pixel + side;
  for (int i = 0; i < reach && IsInside(view.depth_m, beyond) && !(DepthAt(view, beyond) > 0);
       ++i) {
    beyond += side;
  }
  if (!IsInside(view.depth_m, beyond)) return true;
  return IsMasked(view, beyond) &&
         std::abs(DepthAt(view, beyond) - DepthAt(view, pixel)) <= options.mask_margin_depth_m;
}

double CutShare(const std::vector<cv::Point>& pixels, const PieceView& view,
                const KeyframeCloudOptions& options) {
  int cut = 0, outline = 0;
  for (const cv::Point pixel : pixels) {
    for (const cv::Point side : kSides) {
      if (IsSameSurface(view, pixel, pixel + side, options)) continue;
      ++outline;
      cut += IsCut(view, pixel, side, options) ? 1 : 0;
    }
  }
  return outline == 0 ? 0 : static_cast<double>(cut) / outline;
}

/// What other views show at the places of a piece's pixels, in pixels.
struct Sightings {
  double moving = 0;   ///< something farther away, or a mask over the same depth
  double resting = 0;  ///< the same depth, and no mask
};

/// Adds what `other` shows of a piece of `view`.
void AddSightings(const SurfacePiece& piece, const PieceView& view, const PieceView& other,
                  const PinholeCamera& camera, std::span<const Eigen::Vector2f> rays,
                  Sightings& sightings) {
  constexpr std::size_t kSamples = 64;  // at least, where the piece has so many
  constexpr float kThrough_m = .06F, kThroughSigmas = 4, kAlike_m = .1F;
  const int step = camera.width / view.depth_m.cols;
  const std::size_t stride = std::max<std::size_t>(1, piece.pixels.size() / kSamples);
  const RigidTransform other_from_view =
      other.reference_from_view.Inverse() * view.reference_from_view;
  for (std::size_t i = 0; i < piece.pixels.size(); i += stride) {
    const cv::Point pixel = piece.pixels[i];
    const Eigen::Vector2f& ray =
        rays[static_cast<std::size_t>(pixel.y) * step * camera.width + pixel.x * step];
    const Eigen::Vector3f point = Eigen::Vector3f(ray.x(), ray.y(), 1) * DepthAt(view, pixel);
    const Eigen::Vector3d there = other_from_view * point.cast<double>();
    if (there.z() < .1) continue;
    const Eigen::Vector2d at = camera.Project(there) / step;
    if (!(at.cwiseAbs().maxCoeff() < 1e6)) continue;
    const cv::Point seen(static_cast<int>(std::lround(at.x())),
                         static_cast<int>(std::lround(at.y())));
    if (!IsInside(other.depth_m, seen) || !(DepthAt(other, seen) > 0)) continue;
    const auto farther_m = static_cast<float>(DepthAt(other, seen) - there.z());
    const bool through = farther_m > kThrough_m + kThroughSigmas * DepthSigma(DepthAt(view, pixel));
    if (through || (farther_m > -kAlike_m && IsMasked(other, seen))) {
      sightings.moving += 1;
    } else if (farther_m > -kAlike_m) {
      sightings.resting += 1;
    }
  }
}

/// How much speaks for a piece's being part of what moves; the larger it is the more must speak, as
/// the room lacks more where that is wrong. With these weights it tells people's pieces from the
/// room's about as well as a logistic regression over 17 figures of a piece (docs/results.md).
double Looseness(const SurfacePiece& piece, const Sightings& sightings, std::size_t image_px) {
  constexpr double kPrior = 60;  // sightings, half of them of something moving
  constexpr double kCutWeight = .5, kSizeWeight = .15, kSmallShare = 1.3e-3;
  const double moving =
      (sightings.moving + kPrior / 2) / (sightings.moving + sightings.resting + kPrior);
  const double share = static_cast<double>(piece.pixels.size()) / static_cast<double>(image_px);
  return moving + kCutWeight * piece.cut_share - kSizeWeight * std::log1p(share / kSmallShare);
}

}  // namespace

std::vector<SurfacePiece> FindSurfacePieces(const PieceView& view,
                                            const KeyframeCloudOptions& options) {
  const double most_px = options.max_piece_share * static_cast<double>(view.depth_m.total());
  std::vector<SurfacePiece> pieces;
  for (DepthRegion& region : FindDepthRegionsIf(
           view.dynamic == 0, view.depth_m,
           [&](float here_m, float there_m) { return IsSmooth(here_m, there_m, options); })) {
    if (static_cast<double>(region.pixels.size()) > most_px) continue;
    const double cut_share = CutShare(region.pixels, view, options);
    pieces.push_back({std::move(region.pixels), cut_share});
  }
  return pieces;
}

std::vector<cv::Mat> FindLoosePieces(std::span<const PieceView> views, const PinholeCamera& camera,
                                     std::span<const Eigen::Vector2f> rays,
                                     const KeyframeCloudOptions& options) {
  constexpr std::size_t kMaxOthers = 10;
  const std::size_t every = (views.size() + kMaxOthers - 1) / kMaxOthers;
  std::vector<cv::Mat> loose;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const PieceView& view = views[i];
    cv::Mat& found = loose.emplace_back(cv::Mat::zeros(view.depth_m.size(), CV_8UC1));
    if (views.size() == 1) break;
    for (const SurfacePiece& piece : FindSurfacePieces(view, options)) {
      Sightings sightings;
      for (std::size_t j = i % every; j < views.size(); j += every) {
        if (j != i) AddSightings(piece, view, views[j], camera, rays, sightings);
      }
      if (Looseness(piece, sightings, found.total()) <= options.max_looseness) continue;
      for (const cv::Point pixel : piece.pixels) found.at<std::uint8_t>(pixel) = 255;
    }
  }
  return loose;
}

}  // namespace ofm
