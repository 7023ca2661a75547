#include "ofm/tracking/match_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ofm/features/orb_extractor.h"
#include "ofm/features/test_images.h"
#include "ofm/map/test_map.h"

namespace ofm {
namespace {

constexpr double kDepth_m = 2;

/// A textured wall kDepth_m before a camera at the origin, seen again by one that has moved along
/// it.
class MatchAlignment : public testing::Test {
 protected:
  MatchAlignment()
      : wall_(TexturedImage(model_.camera.width, model_.camera.height)),
        moved_(test::CameraAt(0.0137, -0.0071, 0)) {
    cv::GaussianBlur(wall_, wall_, {}, 1);
    const Eigen::Vector2d shift = TrueShift();
    cv::Mat seen;
    cv::warpAffine(wall_, seen, cv::Matx23d(1, 0, shift.x(), 0, 1, shift.y()), wall_.size(),
                   cv::INTER_CUBIC, cv::BORDER_REFLECT);
    const auto first = Take(wall_);
    second_ = Take(seen);
    Keyframe keyframe = test::MakeTestKeyframe(first);
    first_ = map_.AddKeyframe(std::move(keyframe));
    MatchByPlace(*first, first_);
  }

  Eigen::Vector2d TrueShift() const {
    const Eigen::Vector3d wall_point(0, 0, kDepth_m);
    return model_.camera.ProjectIdeal(moved_ * wall_point) - model_.camera.ProjectIdeal(wall_point);
  }

  std::shared_ptr<const FrameFeatures> Take(const cv::Mat& gray) const {
    OrbExtractor extractor{OrbOptions{}};
    const cv::Mat depth_m(gray.size(), CV_32FC1, cv::Scalar(kDepth_m));
    return MakeFrameFeatures(extractor.Extract(gray), depth_m, model_.camera);
  }

  /// Landmarks of the first view's features that the second has too, the nearest within 1 px.
  void MatchByPlace(const FrameFeatures& first, KeyframeId id) {
    for (int i = 0; i < static_cast<int>(first.size()); ++i) {
      const Eigen::Vector2f expected = first.ideal_px[i] + TrueShift().cast<float>();
      for (int k = 0; k < static_cast<int>(second_->size()); ++k) {
        const bool same_octave = second_->keypoints[k].octave == first.keypoints[i].octave;
        if (!same_octave || (second_->ideal_px[k] - expected).norm() > 1) continue;
        const Eigen::Vector3d point =
            model_.camera.UnprojectIdeal(first.ideal_px[i].cast<double>(), kDepth_m);
        matches_.push_back({k, map_.AddLandmark(point, id, i), point});
        break;
      }
    }
  }

  FrameView View(const FrameFeatures& features) const { return {features, moved_}; }

  std::shared_ptr<FrameFeatures> Align(const FrameFeatures& features) {
    return AlignMatches(model_, {}, *map_.Snapshot(), View(features), matches_);
  }

  /// Root mean square of what the matches' places are off [px].
  double PlaceError(const FrameFeatures& features) const {
    double sum = 0;
    for (const PointMatch& match : matches_) {
      sum += (model_.camera.ProjectIdeal(moved_ * match.point_in_world) -
              features.ideal_px[match.feature].cast<double>())
                 .squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(matches_.size()));
  }

  MeasurementModel model_{PinholeCamera(), test::TestScales(), {}};
  cv::Mat wall_;
  RigidTransform moved_;
  std::shared_ptr<const FrameFeatures> second_;
  Map map_{test::TestScales()};
  KeyframeId first_;
  std::vector<PointMatch> matches_;
};

TEST_F(MatchAlignment, PutsMostFeaturesToASmallPartOfAPixel) {
  ASSERT_GT(matches_.size(), 300U);
  const auto aligned = Align(*second_);
  const auto count = std::ranges::count(aligned->is_aligned, char{1});
  EXPECT_GT(count, static_cast<long>(0.9 * static_cast<double>(matches_.size())));
  EXPECT_LT(PlaceError(*aligned), 0.5 * PlaceError(*second_));
}

TEST_F(MatchAlignment, LeavesTheOthersWhereTheyAre) {
  const auto aligned = Align(*second_);
  for (std::size_t i = 0; i < second_->size(); ++i) {
    if (aligned->is_aligned[i] != 0) continue;
    EXPECT_EQ(aligned->keypoints[i].pixel, second_->keypoints[i].pixel);
    EXPECT_EQ(aligned->ideal_px[i], second_->ideal_px[i]);
  }
}

TEST_F(MatchAlignment, WithoutPatchesNothingIsAligned) {
  FrameFeatures bare = *second_;
  bare.patches = nullptr;
  const auto aligned = Align(bare);
  EXPECT_EQ(std::ranges::count(aligned->is_aligned, char{1}), 0);
  EXPECT_EQ(PlaceError(*aligned), PlaceError(*second_));
}

TEST_F(MatchAlignment, TakesTheOldestKeyframeWithPatchesWhereThatWhichMadeALandmarkHasNone) {
  const auto expected = Align(*second_);
  const auto snapshot = map_.Snapshot();
  const Keyframe& first = *snapshot->keyframes.Find(first_);
  auto bare = std::make_shared<FrameFeatures>(*first.features);
  bare->patches = nullptr;
  Map loaded{test::TestScales()};
  const KeyframeId without = loaded.AddKeyframe(test::MakeTestKeyframe(bare));
  const KeyframeId with = loaded.AddKeyframe(test::MakeTestKeyframe(first.features));
  for (PointMatch& match : matches_) {
    const int feature = snapshot->FindLandmark(match.landmark)->observations.front().feature;
    match.landmark = loaded.AddLandmark(match.point_in_world, without, feature);
    loaded.AddObservation(match.landmark, with, feature);
  }
  const auto aligned = AlignMatches(model_, {}, *loaded.Snapshot(), View(*second_), matches_);
  EXPECT_EQ(aligned->ideal_px, expected->ideal_px);
}

TEST_F(MatchAlignment, NoiseIsTheTypicalResidualTimesTheScale) {
  FrameFeatures shifted = *Align(*second_);
  for (const PointMatch& match : matches_) {
    const double scale = model_.scales.Scale(shifted.keypoints[match.feature].octave);
    const Eigen::Vector2d place = model_.camera.ProjectIdeal(moved_ * match.point_in_world);
    shifted.ideal_px[match.feature] = (place + Eigen::Vector2d(0.3 * scale, 0)).cast<float>();
  }
  MatchAlignmentOptions options;
  options.noise_scale = 2;
  options.min_noise = 0.1;
  EXPECT_NEAR(MeasureAlignedNoise(model_, options, View(shifted), matches_), 2 * 0.3 / 1.1774,
              1e-3);
  options.noise_scale = 10;
  EXPECT_EQ(MeasureAlignedNoise(model_, options, View(shifted), matches_), 1);
  options.noise_scale = 0.1;
  EXPECT_EQ(MeasureAlignedNoise(model_, options, View(shifted), matches_), 0.1);
}

TEST_F(MatchAlignment, NoiseOfFewIsThatOfCorners) {
  const auto aligned = Align(*second_);
  matches_.resize(10);
  EXPECT_EQ(MeasureAlignedNoise(model_, {}, View(*aligned), matches_), 1);
}

/// Depth whose inverse is off by `error` [1/m].
void SetDepth(double error, FrameFeatures& features) {
  std::ranges::fill(features.depth_m, static_cast<float>(1 / (1 / kDepth_m + error)));
}

TEST_F(MatchAlignment, DepthNoiseIsTheTypicalResidualTimesTheScale) {
  MatchAlignmentOptions options;
  options.depth_noise_scale = 2;
  options.min_depth_noise = 0.1;
  FrameFeatures seen = *Align(*second_);
  seen.aligned_noise = static_cast<float>(options.min_noise);
  SetDepth(0.2 * model_.options.inverse_depth_sigma, seen);
  EXPECT_NEAR(MeasureDepthNoise(model_, options, View(seen), matches_), 2 * 0.2 / 0.6745, 1e-3);
  SetDepth(0, seen);
  EXPECT_EQ(MeasureDepthNoise(model_, options, View(seen), matches_), 0.1);
  SetDepth(model_.options.inverse_depth_sigma, seen);
  EXPECT_EQ(MeasureDepthNoise(model_, options, View(seen), matches_), 1);
}

TEST_F(MatchAlignment, DepthIsNotTrustedMoreWhereThePlacesDoNotAgree) {
  MatchAlignmentOptions options;
  FrameFeatures seen = *Align(*second_);
  SetDepth(0, seen);
  seen.aligned_noise = 1;
  EXPECT_EQ(MeasureDepthNoise(model_, options, View(seen), matches_), 1);
  seen.aligned_noise = static_cast<float>(1.5 * options.min_noise);
  EXPECT_NEAR(MeasureDepthNoise(model_, options, View(seen), matches_), 0.5, 1e-6);
}

TEST_F(MatchAlignment, DepthNoiseOfFewIsWhatIsExpected) {
  FrameFeatures seen = *Align(*second_);
  seen.aligned_noise = 0;
  std::ranges::fill(seen.depth_m, 0.0F);
  EXPECT_EQ(MeasureDepthNoise(model_, {}, View(seen), matches_), 1);
}

}  // namespace
}  // namespace ofm
