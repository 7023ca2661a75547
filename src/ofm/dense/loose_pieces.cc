#include "ofm/dense/loose_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ofm/base/check.h"
#include "ofm/camera/depth_noise.h"

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

/// Grows the pieces of one view.
class PieceGrower {
 public:
  PieceGrower(const PieceView& view, const KeyframeCloudOptions& options)
      : view_(view), options_(options), open_((view.depth_m > 0) & (view.dynamic == 0)) {}

  std::vector<SurfacePiece> Grow() {
    std::vector<SurfacePiece> pieces;
    for (int y = 0; y < open_.rows; ++y) {
      for (int x = 0; x < open_.cols; ++x) {
        if (open_.ptr<std::uint8_t>(y)[x] == 0) continue;
        SurfacePiece piece = GrowFrom({x, y});
        if (!IsTooLarge(piece)) pieces.push_back(std::move(piece));
      }
    }
    return pieces;
  }

 private:
  SurfacePiece GrowFrom(cv::Point seed) {
    SurfacePiece piece{{seed}, 0};
    open_.at<std::uint8_t>(seed) = 0;
    int cut = 0, outline = 0;
    for (std::size_t next = 0; next < piece.pixels.size(); ++next) {
      const cv::Point pixel = piece.pixels[next];
      for (const cv::Point side : kSides) {
        if (IsSameSurface(pixel, pixel + side)) {
          std::uint8_t& open = open_.at<std::uint8_t>(pixel + side);
          if (open != 0) piece.pixels.push_back(pixel + side);
          open = 0;
        } else if (!IsTooLarge(piece)) {
          ++outline;
          cut += IsCut(pixel, side) ? 1 : 0;
        }
      }
    }
    piece.cut_share = outline == 0 ? 0 : static_cast<double>(cut) / outline;
    return piece;
  }

  bool IsTooLarge(const SurfacePiece& piece) const {
    return static_cast<double>(piece.pixels.size()) >
           options_.max_piece_share * static_cast<double>(open_.total());
  }

  bool IsSameSurface(cv::Point pixel, cv::Point other) const {
    if (!IsInside(open_, other) || IsMasked(view_, other)) return false;
    const float here_m = DepthAt(view_, pixel), there_m = DepthAt(view_, other);
    return there_m > 0 && std::abs(there_m - here_m) <=
                              options_.edge_sigmas * DepthSigma(std::min(here_m, there_m));
  }

  /// Whether a surface goes on beyond its outline at `pixel`, for all that can be told.
  bool IsCut(cv::Point pixel, cv::Point side) const {
    const int kReach = view_.depth_m.cols / 8;  // across a structured-light camera's shadow
    cv::Point beyond = pixel + side;
    for (int i = 0; i < kReach && IsInside(open_, beyond) && !(DepthAt(view_, beyond) > 0); ++i) {
      beyond += side;
    }
    if (!IsInside(open_, beyond)) return true;
    return IsMasked(view_, beyond) &&
           std::abs(DepthAt(view_, beyond) - DepthAt(view_, pixel)) <= options_.mask_margin_depth_m;
  }

  const PieceView& view_;
  const KeyframeCloudOptions& options_;
  cv::Mat open_;  // 255 where no piece has been yet
};

/// What other views show at the places of a piece's pixels, in pixels.
struct Sightings {
  double moving = 0;   ///< something farther away, or a mask over the same depth
  double resting = 0;  ///< the same depth, and no mask
};

/// Adds what `other` shows of a piece of `view`.
void AddSightings(const SurfacePiece& piece, const PieceView& view, const PieceView& other,
                  const PinholeCamera& camera, std::span<const Eigen::Vector2f> rays,
                  Sightings& sightings) {
  constexpr std::size_t kMaxSamples = 64;
  constexpr float kThrough_m = .06F, kThroughSigmas = 4, kAlike_m = .1F;
  const int step = camera.width / view.depth_m.cols;
  const std::size_t stride = std::max<std::size_t>(1, piece.pixels.size() / kMaxSamples);
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
  OFM_CHECK(view.depth_m.type() == CV_32FC1 && view.dynamic.type() == CV_8UC1);
  OFM_CHECK(view.depth_m.size() == view.dynamic.size());
  return PieceGrower(view, options).Grow();
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
