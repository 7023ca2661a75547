#include "ofm/sim/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

const PinholeCamera kCamera = MakeSimCamera(320, 240);

SensorNoiseOptions Kinect() {
  SensorNoiseOptions options;
  options.model = NoiseModel::kKinect;
  return options;
}

/// A grey image with one depth throughout.
RenderedImage FlatImage(float depth_m) {
  return {cv::Mat(240, 320, CV_8UC3, cv::Scalar::all(128)),
          cv::Mat(240, 320, CV_32FC1, cv::Scalar(depth_m)), cv::Mat::zeros(240, 320, CV_8UC1)};
}

RenderedImage Disturbed(const SensorNoiseOptions& options, RenderedImage image,
                        std::uint32_t frame = 0, std::uint64_t seed = 1) {
  SensorNoise(options, kCamera, seed).Apply(frame, image);
  return image;
}

std::pair<double, double> MeanAndDeviation(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[0], deviation[0]};
}

TEST(SensorNoise, NoneLeavesTheImageAlone) {
  const RenderedImage image = Disturbed({}, FlatImage(2));
  EXPECT_EQ(cv::norm(image.depth_m, FlatImage(2).depth_m, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(image.color, FlatImage(2).color, cv::NORM_INF), 0);
}

TEST(SensorNoise, ProjectorsShadowLiesLeftOfWhatIsNear) {
  SensorNoiseOptions options = Kinect();
  options.depth_sigma = options.disparity_step_px = options.edge_dropout = 0;
  options.shadow = 1;
  RenderedImage image = FlatImage(3);
  image.depth_m(cv::Rect(150, 0, 60, 240)).setTo(1);
  const cv::Mat depth_m = Disturbed(options, image).depth_m;
  const int width = cvRound(kCamera.fx * kCamera.baseline_m * (1 / 1.0 - 1 / 3.0));
  EXPECT_EQ(depth_m.at<float>(100, 150), 1);
  EXPECT_EQ(depth_m.at<float>(100, 149), 0);
  EXPECT_EQ(depth_m.at<float>(100, 150 - width + 2), 0);
  EXPECT_EQ(depth_m.at<float>(100, 150 - width - 2), 3);
  EXPECT_EQ(depth_m.at<float>(100, 211), 3);
}

TEST(SensorNoise, BlackSurfacesLoseBlocksOfDepth) {
  SensorNoiseOptions options = Kinect();
  options.dark_dropout = 0.5;
  options.edge_dropout = 0;  // holes have edges too
  RenderedImage image = FlatImage(2);
  image.color(cv::Rect(0, 0, 160, 240)).setTo(cv::Scalar::all(10));
  const cv::Mat depth_m = Disturbed(options, image).depth_m;
  EXPECT_NEAR(cv::countNonZero(depth_m(cv::Rect(0, 0, 160, 240))) / (160.0 * 240), 0.5, 0.05);
  EXPECT_EQ(cv::countNonZero(depth_m(cv::Rect(160, 0, 160, 240))), 160 * 240);
}

class NoiseAtDepth : public testing::TestWithParam<float> {};

TEST_P(NoiseAtDepth, DeviationIsTheModelsQuantisationIncluded) {
  const double z = GetParam();
  const auto [mean, deviation] =
      MeanAndDeviation(Disturbed(Kinect(), FlatImage(GetParam())).depth_m);
  EXPECT_NEAR(deviation, 1.4e-3 * z * z, 0.1 * 1.4e-3 * z * z);
  EXPECT_NEAR(mean, z, 0.3e-3 * z * z);
}

TEST_P(NoiseAtDepth, DepthComesInStepsOfDisparity) {
  const double z = GetParam();
  const cv::Mat depth_m = Disturbed(Kinect(), FlatImage(GetParam())).depth_m;
  const std::set<float> values(depth_m.begin<float>(), depth_m.end<float>());
  EXPECT_LE(values.size(), 12U);
  EXPECT_GE(values.size(), 3U);
  const double step_m = z * z * 0.125 / (0.075 * 580);
  EXPECT_NEAR(*std::next(values.begin()) - *values.begin(), step_m, 0.2 * step_m);
}

INSTANTIATE_TEST_SUITE_P(SensorNoise, NoiseAtDepth, testing::Values(0.8F, 1.5F, 2.5F, 4.5F));

TEST(SensorNoise, WithoutQuantisationTheDeviationIsTheSame) {
  SensorNoiseOptions options = Kinect();
  options.disparity_step_px = 0;
  const auto [mean, deviation] = MeanAndDeviation(Disturbed(options, FlatImage(2)).depth_m);
  EXPECT_NEAR(deviation, 1.4e-3 * 4, 1e-4);
  EXPECT_NEAR(mean, 2, 1e-4);
}

TEST(SensorNoise, OutsideItsRangeNothingIsMeasured) {
  EXPECT_EQ(cv::countNonZero(Disturbed(Kinect(), FlatImage(0.39F)).depth_m), 0);
  EXPECT_EQ(cv::countNonZero(Disturbed(Kinect(), FlatImage(5.01F)).depth_m), 0);
  EXPECT_EQ(cv::countNonZero(Disturbed(Kinect(), FlatImage(0)).depth_m), 0);
  EXPECT_EQ(cv::countNonZero(Disturbed(Kinect(), FlatImage(1)).depth_m), 320 * 240);
}

TEST(SensorNoise, ShareOfTheEdgePixelsDropsOut) {
  RenderedImage image = FlatImage(3);
  image.depth_m(cv::Rect(100, 0, 100, 240)).setTo(1);
  const cv::Mat missing = Disturbed(Kinect(), image).depth_m == 0;
  const int edge_pixels = 4 * 240;
  EXPECT_NEAR(cv::countNonZero(missing), 0.6 * edge_pixels, 0.06 * edge_pixels);
  for (const int column : {99, 100, 199, 200}) missing.col(column).setTo(0);
  EXPECT_EQ(cv::countNonZero(missing), 0);
}

TEST(SensorNoise, ImageNoiseHasItsDeviationInEveryChannel) {
  const RenderedImage image = Disturbed(Kinect(), FlatImage(2));
  cv::Scalar mean, deviation;
  cv::meanStdDev(image.color, mean, deviation);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c], 128, 0.1);
    EXPECT_NEAR(deviation[c], std::sqrt(4 + 1 / 12.0), 0.1);
  }
}

TEST(SensorNoise, SameFrameGivesTheSameBytesAndAnotherFrameOrSeedOthers) {
  const RenderedImage a = Disturbed(Kinect(), FlatImage(2), 7, 1);
  const RenderedImage same = Disturbed(Kinect(), FlatImage(2), 7, 1);
  EXPECT_EQ(cv::norm(a.depth_m, same.depth_m, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.color, same.color, cv::NORM_INF), 0);
  for (const RenderedImage& other :
       {Disturbed(Kinect(), FlatImage(2), 8, 1), Disturbed(Kinect(), FlatImage(2), 7, 2)}) {
    EXPECT_GT(cv::countNonZero(a.depth_m != other.depth_m), 20000);
    EXPECT_GT(cv::norm(a.color, other.color, cv::NORM_L1), 20000);
  }
}

TEST(SensorNoise, NeighbouringPixelsAreIndependent) {
  SensorNoiseOptions options = Kinect();
  options.disparity_step_px = 0;
  const cv::Mat noise = Disturbed(options, FlatImage(2)).depth_m - 2;
  const double variance = noise.dot(noise) / static_cast<double>(noise.total());
  const cv::Mat left = noise.colRange(0, 319), right = noise.colRange(1, 320);
  const cv::Mat above = noise.rowRange(0, 239), below = noise.rowRange(1, 240);
  EXPECT_LT(std::abs(left.dot(right) / static_cast<double>(left.total())), 0.03 * variance);
  EXPECT_LT(std::abs(above.dot(below) / static_cast<double>(above.total())), 0.03 * variance);
}

}  // namespace
}  // namespace ofm
