#include "ofm/features/orb_extractor.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "ofm/features/matching.h"
#include "ofm/features/orb_kernels.h"
#include "ofm/features/test_images.h"

namespace ofm {
namespace {

void ExpectSame(const Features& a, const Features& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.descriptors, b.descriptors);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.keypoints[i].pixel, b.keypoints[i].pixel);
    EXPECT_EQ(a.keypoints[i].octave, b.keypoints[i].octave);
    EXPECT_EQ(a.keypoints[i].angle_rad, b.keypoints[i].angle_rad);
    EXPECT_EQ(a.keypoints[i].response, b.keypoints[i].response);
  }
}

/// Warped by `to_b` (2 x 3, pixel centres at whole numbers).
cv::Mat Warp(const cv::Mat& image, const cv::Matx23d& to_b, cv::Size size) {
  cv::Mat warped;
  cv::warpAffine(image, warped, to_b, size, cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return warped;
}

struct MatchSummary {
  int matches = 0, correct = 0;
  double mean_octave_shift = 0, mean_rotation_rad = 0;  ///< b minus a, of the correct ones
};

MatchSummary MatchWarped(const Features& a, const Features& b, const cv::Matx23d& to_b) {
  MatchSummary summary;
  double sine = 0, cosine = 0;
  for (const FeatureMatch& match : MatchBruteForce(a.descriptors, b.descriptors)) {
    const Keypoint &p = a.keypoints[match.a], &q = b.keypoints[match.b];
    const cv::Vec2d expected = to_b * cv::Vec3d(p.pixel.x(), p.pixel.y(), 1);
    ++summary.matches;
    if (cv::norm(expected - cv::Vec2d(q.pixel.x(), q.pixel.y())) > 6) continue;
    ++summary.correct;
    summary.mean_octave_shift += q.octave - p.octave;
    sine += std::sin(q.angle_rad - p.angle_rad);
    cosine += std::cos(q.angle_rad - p.angle_rad);
  }
  summary.mean_octave_shift /= std::max(1, summary.correct);
  summary.mean_rotation_rad = std::atan2(sine, cosine);
  return summary;
}

TEST(OrbExtractor, SameImageGivesSameFeatures) {
  const cv::Mat image = TexturedImage(320, 240);
  OrbExtractor extractor{OrbOptions{}}, other{OrbOptions{}};
  const Features first = extractor.Extract(image);
  EXPECT_EQ(first.size(), 1000u);
  extractor.Extract(TexturedImage(200, 300, 2));  // leaves no trace
  ExpectSame(first, extractor.Extract(image));
  ExpectSame(first, other.Extract(image));
}

TEST(OrbExtractor, PortableAndVectorKernelsGiveTheSameFeatures) {
  if (Avx2OrbKernels() == nullptr) GTEST_SKIP() << "this processor has no AVX2";
  for (const cv::Mat& image : {TexturedImage(321, 243), NoiseImage(160, 120)}) {
    OrbExtractor portable(OrbOptions{}, PortableOrbKernels());
    OrbExtractor vector(OrbOptions{}, *Avx2OrbKernels());
    ExpectSame(portable.Extract(image), vector.Extract(image));
  }
}

TEST(OrbExtractor, FieldsAreInTheirRanges) {
  const cv::Mat image = TexturedImage(320, 240);
  OrbExtractor extractor{OrbOptions{}};
  std::set<int> octaves;
  for (const Keypoint& keypoint : extractor.Extract(image).keypoints) {
    EXPECT_GE(keypoint.angle_rad, 0);
    EXPECT_LT(keypoint.angle_rad, 2 * std::numbers::pi);
    EXPECT_GT(keypoint.response, 0);
    EXPECT_GE(keypoint.pixel.minCoeff(), 15);
    EXPECT_LE(keypoint.pixel.x(), 320 - 15);
    EXPECT_LE(keypoint.pixel.y(), 240 - 15);
    octaves.insert(keypoint.octave);
  }
  EXPECT_EQ(octaves, (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(OrbExtractor, ExcludedPixelsHaveNoKeypointsAndTheRestHasMore) {
  const cv::Mat image = TexturedImage(320, 240);
  cv::Mat excluded = cv::Mat::zeros(image.size(), CV_8UC1);
  excluded.colRange(0, 160).setTo(1);
  cv::circle(excluded, {240, 120}, 30, 255, cv::FILLED);
  OrbOptions options;
  options.count = 300;
  const Features features = OrbExtractor(options).Extract(image, excluded);
  EXPECT_EQ(features.size(), 300u);
  for (const Keypoint& keypoint : features.keypoints) {
    const cv::Point pixel(static_cast<int>(std::lround(keypoint.pixel.x())),
                          static_cast<int>(std::lround(keypoint.pixel.y())));
    EXPECT_EQ(excluded.at<std::uint8_t>(pixel), 0) << pixel;
  }
}

TEST(OrbExtractor, AnImageThatIsAllExcludedHasNoFeatures) {
  const cv::Mat image = TexturedImage(100, 100);
  EXPECT_EQ(OrbExtractor(OrbOptions{}).Extract(image, cv::Mat::ones(100, 100, CV_8UC1)).size(), 0u);
}

int OccupiedCells(const std::vector<Eigen::Vector2f>& pixels) {
  std::set<std::pair<int, int>> cells;
  for (const Eigen::Vector2f& pixel : pixels) {
    cells.emplace(static_cast<int>(pixel.x() / 20), static_cast<int>(pixel.y() / 20));
  }
  return static_cast<int>(cells.size());
}

TEST(OrbExtractor, WithFullEvennessCoversMoreOfTheImageThanOpenCv) {
  // Strong texture on the left, the same with a quarter of the contrast on the right.
  cv::Mat image = TexturedImage(480, 360);
  cv::Mat right = image.colRange(200, 480);
  right.convertTo(right, CV_8U, 0.25, 90);
  OrbOptions options;
  options.count = 500;
  options.evenness = 1;
  std::vector<Eigen::Vector2f> ours, theirs;
  for (const Keypoint& k : OrbExtractor(options).Extract(image).keypoints) ours.push_back(k.pixel);
  std::vector<cv::KeyPoint> keypoints;
  cv::ORB::create(500)->detect(image, keypoints);
  for (const cv::KeyPoint& k : keypoints) theirs.emplace_back(k.pt.x, k.pt.y);
  EXPECT_GT(OccupiedCells(ours), 1.5 * OccupiedCells(theirs));
}

TEST(OrbExtractor, DescriptorsFollowARotationOfTheImage) {
  const cv::Mat image = TexturedImage(300, 300);
  OrbExtractor extractor{OrbOptions{}};
  const Features features = extractor.Extract(image);
  for (const double degrees : {30.0, 90.0, 135.0, 200.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle), m = 149.5;
    const cv::Matx23d turn(c, -s, m - c * m + s * m, s, c, m - s * m - c * m);
    const MatchSummary summary =
        MatchWarped(features, extractor.Extract(Warp(image, turn, image.size())), turn);
    EXPECT_GT(summary.correct, 250) << degrees;
    EXPECT_GT(summary.correct, 0.9 * summary.matches) << degrees;
    EXPECT_NEAR(std::remainder(summary.mean_rotation_rad - angle, 2 * std::numbers::pi), 0, 0.03);
  }
}

TEST(OrbExtractor, AScaledImageShiftsTheOctave) {
  const cv::Mat image = TexturedImage(480, 360);
  OrbExtractor extractor{OrbOptions{}};
  const double scale = 1 / 1.728;  // three octaves down
  const double shift = 0.5 * scale - 0.5;
  const cv::Matx23d shrink(scale, 0, shift, 0, scale, shift);
  cv::Mat smoothed;
  cv::GaussianBlur(image, smoothed, {}, 0.7);
  const cv::Mat small = Warp(smoothed, shrink, {278, 208});
  const MatchSummary summary =
      MatchWarped(extractor.Extract(image), extractor.Extract(small), shrink);
  EXPECT_GT(summary.correct, 150);
  EXPECT_GT(summary.correct, 0.9 * summary.matches);
  EXPECT_NEAR(summary.mean_octave_shift, -3, 0.3);
}

TEST(OrbExtractor, ScaleOfAnOctaveIsAPowerOfTheFactor) {
  const OrbExtractor extractor{OrbOptions{}};
  EXPECT_FLOAT_EQ(extractor.ScaleOf(0), 1);
  EXPECT_FLOAT_EQ(extractor.ScaleOf(3), 1.728f);
}

/// Rendered eight times finer, moved there, and brought to size.
cv::Mat TextureMovedBy(int eighths) {
  cv::Mat fine, image;
  cv::resize(TexturedImage(300, 240), fine, {}, 8, 8, cv::INTER_CUBIC);
  cv::resize(fine(cv::Rect(64 - eighths, 64, 2240, 1760)), image, {280, 220}, 0, 0, cv::INTER_AREA);
  return image;
}

TEST(OrbExtractor, KeypointsMoveWithTheTextureBySubPixels) {
  OrbExtractor extractor{OrbOptions{}};
  const Features still = extractor.Extract(TextureMovedBy(0));
  const Features moved = extractor.Extract(TextureMovedBy(4));
  std::vector<double> errors_px, errors_of_whole_pixels_px;
  for (const FeatureMatch& match : MatchBruteForce(still.descriptors, moved.descriptors)) {
    const Keypoint &p = still.keypoints[match.a], &q = moved.keypoints[match.b];
    const Eigen::Vector2f move = q.pixel - p.pixel;
    if (p.octave != 0 || q.octave != 0 || move.norm() > 2) continue;
    errors_px.push_back(std::abs(move.x() - 0.5));
    errors_of_whole_pixels_px.push_back(
        std::abs(std::round(q.pixel.x()) - std::round(p.pixel.x()) - 0.5));
  }
  ASSERT_GT(errors_px.size(), 50u);
  const auto median = [](std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<int>(values.size() / 2));
    return values[values.size() / 2];
  };
  EXPECT_LT(median(errors_px), 0.15);
  EXPECT_LT(median(errors_px), 0.5 * median(errors_of_whole_pixels_px));
}

TEST(OrbExtractor, TinyAndFlatImagesHaveNoFeatures) {
  OrbExtractor extractor{OrbOptions{}};
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 300), cv::Size(32, 32), cv::Size(0, 0)}) {
    EXPECT_EQ(extractor.Extract(NoiseImage(size.width, size.height)).size(), 0u) << size;
  }
  EXPECT_EQ(extractor.Extract(cv::Mat(240, 320, CV_8UC1, cv::Scalar(128))).size(), 0u);
}

TEST(OrbExtractor, GivesFewerWhereThereAreTooFewCorners) {
  OrbOptions options;
  options.count = 20000;
  const Features features = OrbExtractor(options).Extract(TexturedImage(200, 150));
  EXPECT_GT(features.size(), 100u);
  EXPECT_LT(features.size(), 20000u);
  EXPECT_EQ(features.descriptors.size(), features.keypoints.size());
}

TEST(OrbExtractor, ReadsAPartOfALargerImage) {
  const cv::Mat image = TexturedImage(400, 300);
  const cv::Mat part = image(cv::Rect(33, 21, 250, 200));
  ASSERT_FALSE(part.isContinuous());
  OrbExtractor extractor{OrbOptions{}};
  ExpectSame(extractor.Extract(part), extractor.Extract(part.clone()));
}

TEST(OrbExtractor, RejectsImagesOfAnotherType) {
  OrbExtractor extractor{OrbOptions{}};
  EXPECT_THROW(extractor.Extract(cv::Mat(100, 100, CV_8UC3)), std::logic_error);
  EXPECT_THROW(extractor.Extract(cv::Mat(100, 100, CV_8UC1), cv::Mat(99, 100, CV_8UC1)),
               std::logic_error);
  EXPECT_THROW(extractor.Extract(cv::Mat(100, 100, CV_8UC1), cv::Mat(100, 100, CV_32FC1)),
               std::logic_error);
}

TEST(OrbExtractor, AnotherCountIsAsIfItHadBeenAskedForFromTheStart) {
  const cv::Mat image = TexturedImage(320, 240);
  OrbOptions options;
  options.count = 500;
  OrbExtractor extractor(options);
  ExpectSame(extractor.Extract(image, {}, 300), [&] {
    options.count = 300;
    return OrbExtractor(options).Extract(image);
  }());
  EXPECT_GT(extractor.Extract(image).size(), 400u);
}

TEST(OrbExtractor, KeepsNoPatchesWhereNobodyWantsThem) {
  const cv::Mat image = TexturedImage(320, 240);
  OrbOptions options;
  const Features with = OrbExtractor(options).Extract(image);
  options.patches = false;
  const Features without = OrbExtractor(options).Extract(image);
  EXPECT_FALSE(with.patches.empty());
  EXPECT_TRUE(without.patches.empty());
  ExpectSame(with, without);
}

TEST(OrbExtractor, PatchesShowWhatIsAboutTheKeyPoints) {
  const cv::Mat image = TexturedImage(320, 240);
  OrbExtractor extractor{OrbOptions{}};
  const Features features = extractor.Extract(image);
  ASSERT_EQ(features.patches.size(), features.size());
  cv::Mat smooth;  // as the pyramid smooths its level 0
  cv::sepFilter2D(image, smooth, CV_8U, cv::Matx13f(0.25F, 0.5F, 0.25F),
                  cv::Matx13f(0.25F, 0.5F, 0.25F));
  int checked = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const ImagePatch& patch = features.patches[i];
    EXPECT_TRUE(patch.is_whole);
    const Eigen::Vector2f offset = features.keypoints[i].pixel - patch.centre_px;
    EXPECT_LE(offset.cwiseAbs().maxCoeff(),
              0.51F * extractor.ScaleOf(features.keypoints[i].octave));
    if (features.keypoints[i].octave != 0) continue;
    const cv::Point centre(static_cast<int>(patch.centre_px.x()),
                           static_cast<int>(patch.centre_px.y()));
    for (const cv::Point at : {cv::Point(0, 0), cv::Point(-9, 4), cv::Point(3, 9)}) {
      const Eigen::Vector2f place(static_cast<float>(at.x), static_cast<float>(at.y));
      if (std::max(std::abs(at.x), std::abs(at.y)) == ImagePatch::kRadius) {
        const int index =
            (at.y + ImagePatch::kRadius) * ImagePatch::kSize + at.x + ImagePatch::kRadius;
        EXPECT_NEAR(patch.gray[index], smooth.at<std::uint8_t>(centre + at), 1);
      } else {
        EXPECT_NEAR(patch.At(place), smooth.at<std::uint8_t>(centre + at), 1);
      }
      ++checked;
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(OrbExtractor, PatchesNextToWhatIsExcludedAreNotWhole) {
  const cv::Mat image = TexturedImage(320, 240);
  cv::Mat excluded = cv::Mat::zeros(image.size(), CV_8UC1);
  excluded(cv::Rect(160, 0, 160, 240)).setTo(255);
  OrbExtractor extractor{OrbOptions{}};
  const Features features = extractor.Extract(image, excluded);
  int near = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const float scale = extractor.ScaleOf(features.keypoints[i].octave);
    const float gap = (160 - features.patches[i].centre_px.x()) / scale;
    if (gap >= 5 && gap <= 7) continue;
    EXPECT_EQ(features.patches[i].is_whole, gap > 7);
    near += gap < 5;
  }
  EXPECT_GT(near, 0);
}

}  // namespace
}  // namespace ofm
