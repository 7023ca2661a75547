#include "ofm/features/orb_kernels.h"

#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <vector>

#include "ofm/features/brief_pattern.h"
#include "ofm/features/image_pyramid.h"
#include "ofm/features/test_images.h"

namespace ofm {
namespace {

/// `image` with padded rows.
class Padded {
 public:
  explicit Padded(const cv::Mat& image) {
    image_.Resize(image.cols, image.rows);
    for (int y = 0; y < image.rows; ++y) std::copy_n(image.ptr(y), image.cols, image_.Row(y));
  }
  const PaddedImage& operator*() const { return image_; }
  const PaddedImage* operator->() const { return &image_; }

 private:
  PaddedImage image_;
};

/// Runs the body with both kinds of kernels where this processor has both.
class OrbKernelsOfBothKinds : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Avx2OrbKernels() == nullptr) GTEST_SKIP() << "this processor has no AVX2";
  }
  const OrbKernels& portable_ = PortableOrbKernels();
  const OrbKernels& avx2() const { return *Avx2OrbKernels(); }
  // Noise has many different pixels, texture has corners; the odd width leaves a rest.
  const std::vector<cv::Mat> images_ = {NoiseImage(131, 61), TexturedImage(131, 61),
                                        cv::Mat(61, 131, CV_8UC1, cv::Scalar(255))};
};

std::vector<std::uint8_t> FastRow(const OrbKernels& kernels, const PaddedImage& image, int y,
                                  int threshold) {
  const int n = image.width() - 6;
  std::vector<std::uint8_t> scores(n + kRowPadding);
  kernels.fast_scores(image.Row(y) + 3, image.stride(), n, threshold, scores.data());
  scores.resize(n);
  return scores;
}

TEST_F(OrbKernelsOfBothKinds, GiveTheSameFastScores) {
  for (const cv::Mat& mat : images_) {
    const Padded image(mat);
    for (const int threshold : {0, 7, 20, 100}) {
      for (int y = 3; y < mat.rows - 3; ++y) {
        ASSERT_EQ(FastRow(portable_, *image, y, threshold), FastRow(avx2(), *image, y, threshold));
      }
    }
  }
}

TEST_F(OrbKernelsOfBothKinds, FindTheSameMaxima) {
  for (const cv::Mat& mat : images_) {
    const Padded image(mat);  // taken for scores
    for (int y = 1; y < mat.rows - 1; ++y) {
      std::vector<std::uint16_t> columns[2];
      int counts[2];
      for (int i = 0; i < 2; ++i) {
        columns[i].resize(mat.cols);
        counts[i] = (i == 0 ? portable_ : avx2())
                        .find_maxima(image->Row(y - 1) + 1, image->Row(y) + 1,
                                     image->Row(y + 1) + 1, mat.cols - 2, columns[i].data());
        columns[i].resize(counts[i]);
      }
      ASSERT_EQ(columns[0], columns[1]);
    }
  }
}

TEST_F(OrbKernelsOfBothKinds, MakeTheSamePyramid) {
  for (const cv::Mat& mat : images_) {
    for (const double factor : {1.2, 1.9}) {
      ImagePyramid a(4, factor, portable_), b(4, factor, avx2());
      a.Build(mat);
      b.Build(mat);
      for (int level = 0; level < 4; ++level) {
        a.Smooth(level);
        b.Smooth(level);
        for (int y = 0; y < a.image(level).height(); ++y) {
          for (int x = 0; x < a.image(level).width(); ++x) {
            ASSERT_EQ(a.image(level).Row(y)[x], b.image(level).Row(y)[x]) << level;
            ASSERT_EQ(a.smooth(level).Row(y)[x], b.smooth(level).Row(y)[x]) << level;
          }
        }
      }
    }
  }
}

TEST_F(OrbKernelsOfBothKinds, DescribeAPatchAlike) {
  const PatternRotations rotations(kBriefPattern);
  for (const cv::Mat& mat : images_) {
    const Padded image(mat);
    for (int x = 16; x < mat.cols - 16; x += 5) {
      const std::uint8_t* centre = image->Row(30) + x;
      EXPECT_EQ(portable_.structure_tensor(centre, image->stride()),
                avx2().structure_tensor(centre, image->stride()));
      EXPECT_EQ(portable_.centroid(centre, image->stride()),
                avx2().centroid(centre, image->stride()));
      PatchBuffer a, b;
      portable_.copy_patch(centre, image->stride(), a);
      avx2().copy_patch(centre, image->stride(), b);
      EXPECT_EQ(a, b);
      EXPECT_EQ(portable_.describe(a, rotations.At(1.0f)), avx2().describe(b, rotations.At(1.0f)));
    }
  }
}

TEST(OrbKernels, FastScoresAreThoseOfOpenCvsDetector) {
  const cv::Mat mat = TexturedImage(160, 120);
  const Padded image(mat);
  for (const int threshold : {7, 20}) {
    // cv::FAST's score is the largest threshold that still finds the corner: one under ours.
    std::vector<cv::KeyPoint> expected;
    cv::FAST(mat, expected, threshold, false);
    cv::Mat is_corner = cv::Mat::zeros(mat.size(), CV_8UC1);
    for (const cv::KeyPoint& k : expected) is_corner.at<std::uint8_t>(k.pt) = 1;
    ASSERT_GT(expected.size(), 100u);
    for (int y = 3; y < mat.rows - 3; ++y) {
      const auto scores = FastRow(BestOrbKernels(), *image, y, threshold);
      for (int x = 3; x < mat.cols - 3; ++x) {
        ASSERT_EQ(scores[x - 3] > 0, is_corner.at<std::uint8_t>(y, x) != 0) << x << " " << y;
      }
    }
  }
}

TEST(OrbKernels, TheStructureTensorOfARampIsItsGradient) {
  cv::Mat mat(20, 20, CV_8UC1);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x)
      mat.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(3 * x + 5 * y);
  }
  const Padded image(mat);
  EXPECT_EQ(BestOrbKernels().structure_tensor(image->Row(9) + 9, image->stride()),
            (StructureTensor{49 * 24 * 24, 49 * 40 * 40, 49 * 24 * 40}));
}

TEST(OrbKernels, TheCentroidLiesOnTheBrightSide) {
  cv::Mat mat(40, 40, CV_8UC1, cv::Scalar(10));
  mat.colRange(20, 40).setTo(90);
  const Padded image(mat);
  const CentroidMoments moments = BestOrbKernels().centroid(image->Row(20) + 19, image->stride());
  EXPECT_GT(moments.x, 0);
  EXPECT_EQ(moments.y, 0);
}

TEST(OrbKernels, ADescriptorsBitIsSetWhereTheFirstPixelIsDarker) {
  PatchBuffer patch{};
  patch[5] = 1;
  RotatedPattern pattern{};
  pattern[70] = {4, 5};
  pattern[71] = {5, 4};
  const Descriptor descriptor = BestOrbKernels().describe(patch, pattern);
  EXPECT_EQ(descriptor, (Descriptor{0, 1u << 6, 0, 0}));
}

TEST(PatternRotations, AQuarterTurnTurnsThePattern) {
  const PatternRotations rotations(kBriefPattern);
  const float quarter = std::numbers::pi_v<float> / 2;
  const auto offset = [](int x, int y) { return (y + kPatchRadius) * 32 + x + kPatchRadius; };
  for (std::size_t i = 0; i < kBriefPattern.size(); ++i) {
    const BriefTest& t = kBriefPattern[i];
    EXPECT_EQ(rotations.At(0)[i][0], offset(t.x0, t.y0));
    EXPECT_EQ(rotations.At(quarter)[i][1], offset(-t.y1, t.x1));
    EXPECT_EQ(rotations.At(4 * quarter)[i][1], offset(t.x1, t.y1));
  }
}

}  // namespace
}  // namespace ofm
