#include "ofm/features/frame_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace ofm {
namespace {

/// Key points at these pixels with descriptors that number them.
Features FeaturesAt(const std::vector<Eigen::Vector2f>& pixels) {
  Features features;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    features.keypoints.push_back({pixels[i], 1, 0.5F, 9});
    features.descriptors.push_back({i, 0, 0, 0});
  }
  return features;
}

cv::Mat PlainDepth(float depth_m) { return {480, 640, CV_32FC1, cv::Scalar(depth_m)}; }

TEST(OctaveScales, AreThePowersOfTheFactor) {
  const OctaveScales scales(8, 1.2);
  ASSERT_EQ(scales.levels(), 8);
  EXPECT_FLOAT_EQ(scales.Scale(0), 1);
  EXPECT_FLOAT_EQ(scales.Scale(1), 1.2F);
  EXPECT_FLOAT_EQ(scales.Scale(7), 3.5831808F);
}

TEST(OctaveScales, RefuseNoLevelsAndAFactorThatDoesNotGrow) {
  EXPECT_THROW(OctaveScales(0, 1.2), std::logic_error);
  EXPECT_THROW(OctaveScales(8, 1.0), std::logic_error);
}

TEST(OctaveScales, PredictTheFirstOctaveThatIsCoarseEnough) {
  const OctaveScales scales(4, 2);
  EXPECT_EQ(scales.PredictOctave(8, 8), 0);
  EXPECT_EQ(scales.PredictOctave(8, 7.9F), 1);
  EXPECT_EQ(scales.PredictOctave(8, 4), 1);
  EXPECT_EQ(scales.PredictOctave(8, 3.9F), 2);
  EXPECT_EQ(scales.PredictOctave(8, 1), 3);
}

TEST(OctaveScales, PredictionStaysInThePyramid) {
  const OctaveScales scales(4, 2);
  EXPECT_EQ(scales.PredictOctave(8, 100), 0);
  EXPECT_EQ(scales.PredictOctave(8, 0.01F), 3);
  EXPECT_EQ(scales.PredictOctave(8, 0), 3);
  EXPECT_EQ(OctaveScales(1, 2).PredictOctave(8, 1), 0);
}

TEST(FrameFeatures, KeepsKeypointsAndDescriptorsInOrder) {
  const auto frame = MakeFrameFeatures(FeaturesAt({{10, 20}, {30, 40}}), PlainDepth(2), {});
  ASSERT_EQ(frame->size(), 2U);
  EXPECT_EQ(frame->keypoints[1].pixel, Eigen::Vector2f(30, 40));
  EXPECT_EQ(frame->keypoints[1].octave, 1);
  EXPECT_EQ(frame->descriptors[1], (Descriptor{1, 0, 0, 0}));
  EXPECT_EQ(frame->ideal_px[1], Eigen::Vector2f(30, 40)) << "no distortion";
}

TEST(FrameFeatures, RefusesListsOfDifferentLengths) {
  Features features = FeaturesAt({{10, 20}});
  features.descriptors.clear();
  EXPECT_THROW(MakeFrameFeatures(features, PlainDepth(2), {}), std::logic_error);
}

TEST(FrameFeatures, UndistortsThePixels) {
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  const Eigen::Vector2d ideal(80, 400);
  const Eigen::Vector2d pixel = camera.Distort(ideal);
  ASSERT_GT((pixel - ideal).norm(), 2);
  const auto frame = MakeFrameFeatures(FeaturesAt({pixel.cast<float>()}), PlainDepth(2), camera);
  EXPECT_LT((frame->ideal_px[0].cast<double>() - ideal).norm(), 1e-3);
  EXPECT_EQ(frame->keypoints[0].pixel, pixel.cast<float>());
}

TEST(FrameFeatures, ReadsDepthAtTheNearestDistortedPixel) {
  cv::Mat depth = PlainDepth(2);
  depth.at<float>(41, 30) = 3;
  const auto frame =
      MakeFrameFeatures(FeaturesAt({{30.4F, 40.6F}, {29.6F, 41.4F}, {30, 40}}), depth, {});
  EXPECT_EQ(frame->depth_m, (std::vector<float>{3, 3, 2}));

  // With distortion the depth image is distorted too.
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  EXPECT_EQ(MakeFrameFeatures(FeaturesAt({{30, 41}}), depth, camera)->depth_m[0], 3);
}

TEST(FrameFeatures, TakesWhatIsNoDepthForNone) {
  cv::Mat depth = PlainDepth(2);
  depth.at<float>(0, 0) = 0;
  depth.at<float>(0, 1) = std::numeric_limits<float>::quiet_NaN();
  depth.at<float>(0, 2) = std::numeric_limits<float>::infinity();
  depth.at<float>(0, 3) = -1;
  const auto frame = MakeFrameFeatures(FeaturesAt({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), depth, {});
  EXPECT_EQ(frame->depth_m, (std::vector<float>{0, 0, 0, 0}));
}

TEST(FrameFeatures, ReadsNoDepthBeyondTheBorder) {
  cv::Mat depth = PlainDepth(2);
  depth.at<float>(479, 639) = 3;
  depth.at<float>(0, 0) = 4;
  const auto frame = MakeFrameFeatures(FeaturesAt({{639.7F, 479.9F}, {-0.8F, -3}}), depth, {});
  EXPECT_EQ(frame->depth_m, (std::vector<float>{3, 4}));
}

TEST(FrameFeatures, ReadsStaticProbabilityAtTheNearestPixel) {
  cv::Mat probability(480, 640, CV_8UC1, cv::Scalar(255));
  probability.at<std::uint8_t>(41, 30) = 51;
  probability.at<std::uint8_t>(479, 639) = 0;
  const auto frame = MakeFrameFeatures(FeaturesAt({{30.4F, 40.6F}, {30, 40}, {639.9F, 480}}),
                                       PlainDepth(2), {}, probability);
  ASSERT_EQ(frame->static_probability.size(), 3U);
  EXPECT_FLOAT_EQ(frame->StaticProbability(0), 0.2F);
  EXPECT_EQ(frame->StaticProbability(1), 1);
  EXPECT_EQ(frame->StaticProbability(2), 0) << "the nearest pixel of the image";
}

TEST(FrameFeatures, EverythingIsStaticWhereNothingElseIsTold) {
  const auto frame = MakeFrameFeatures(FeaturesAt({{10, 20}, {30, 40}}), PlainDepth(2), {});
  EXPECT_TRUE(frame->static_probability.empty());
  EXPECT_EQ(frame->StaticProbability(1), 1);
}

TEST(FrameFeatures, GridIsOverIdealPixels) {
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  const Eigen::Vector2d ideal(40, 40);
  const Eigen::Vector2f pixel = camera.Distort(ideal).cast<float>();
  const auto frame = MakeFrameFeatures(FeaturesAt({pixel}), PlainDepth(2), camera);
  int visited = 0;
  frame->grid.VisitNear(ideal.cast<float>(), 0.1F, [&](int) { ++visited; });
  EXPECT_EQ(visited, 1);
}

/// The wall z = 2 m of the colour camera as a camera 0.1 m before it would measure it, and a step
/// in it: nearer where x > 0.5 m.
cv::Mat DepthFromNearer(const PinholeCamera& camera) {
  cv::Mat depth = PlainDepth(1.9F);
  const int step = static_cast<int>(std::lround(camera.cx + camera.fx * 0.5 / 1.9));
  depth.colRange(step, depth.cols) = 1.4F;
  return depth;
}

TEST(AlignDepthInTime, CameraThatStoodStillChangesNothing) {
  const auto frame = MakeFrameFeatures(FeaturesAt({{10, 20}, {300, 200}}), PlainDepth(2), {});
  const auto aligned = AlignDepthInTime(*frame, PlainDepth(2), {}, {});
  EXPECT_NEAR(aligned->depth_m[0], 2, 1e-6);
  EXPECT_NEAR(aligned->depth_m[1], 2, 1e-6);
  EXPECT_EQ(aligned->ideal_px, frame->ideal_px);
}

TEST(AlignDepthInTime, AllowsForTheWayThatTheCameraWent) {
  const PinholeCamera camera;
  const cv::Mat depth = DepthFromNearer(camera);
  const RigidTransform forward(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -0.1));
  const auto frame = MakeFrameFeatures(FeaturesAt({{100, 200}, {319, 240}}), depth, camera);
  const auto aligned = AlignDepthInTime(*frame, depth, forward, camera);
  EXPECT_NEAR(frame->depth_m[0], 1.9, 1e-6);
  EXPECT_NEAR(aligned->depth_m[0], 2, 1e-5);
  EXPECT_NEAR(aligned->depth_m[1], 2, 1e-5);
}

TEST(AlignDepthInTime, ReadsWhereThePointIsInTheDepthImage) {
  // The wall's step is at another pixel of the depth image than of the colour image.
  const PinholeCamera camera;
  const cv::Mat depth = DepthFromNearer(camera);
  const RigidTransform forward(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -0.1));
  const auto u = static_cast<float>(camera.cx + camera.fx * 0.49 / 1.9);
  const auto frame = MakeFrameFeatures(FeaturesAt({{u, 240}}), depth, camera);
  EXPECT_NEAR(frame->depth_m[0], 1.9, 1e-6);
  EXPECT_NEAR(AlignDepthInTime(*frame, depth, forward, camera)->depth_m[0], 1.5, 1e-5);
}

TEST(AlignDepthInTime, KeepsWhatItHasWhereTheDepthImageTellsNothing) {
  const cv::Mat depth = PlainDepth(2);
  const auto frame = MakeFrameFeatures(FeaturesAt({{320, 240}, {639, 479}}), depth, {});
  const RigidTransform aside(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(AlignDepthInTime(*frame, PlainDepth(0), aside, {})->depth_m, frame->depth_m);
  EXPECT_EQ(AlignDepthInTime(*frame, depth, aside, {})->depth_m[1], 2) << "left the image";
  const RigidTransform past(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -3));
  EXPECT_EQ(AlignDepthInTime(*frame, depth, past, {})->depth_m, frame->depth_m);
}

TEST(AlignDepthInTime, MakesNoDepthWhereThereWasNone) {
  const auto frame = MakeFrameFeatures(FeaturesAt({{320, 240}}), PlainDepth(0), {});
  EXPECT_EQ(AlignDepthInTime(*frame, PlainDepth(2), {}, {})->depth_m[0], 0);
}

TEST(AlignDepthInTime, KeepsTheStaticProbability) {
  const cv::Mat half(480, 640, CV_8UC1, cv::Scalar(102));
  const auto frame = MakeFrameFeatures(FeaturesAt({{100, 200}}), PlainDepth(2), {}, half);
  const RigidTransform forward(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, -0.1));
  EXPECT_FLOAT_EQ(AlignDepthInTime(*frame, PlainDepth(2), forward, {})->StaticProbability(0), 0.4F);
}

TEST(PointInCamera, IsThePointThatTheFeatureShows) {
  const PinholeCamera camera;
  const Eigen::Vector3d point(0.3, -0.2, 2);
  const auto frame =
      MakeFrameFeatures(FeaturesAt({camera.Project(point).cast<float>()}), PlainDepth(2), camera);
  EXPECT_LT((*PointInCamera(*frame, 0, camera) - point).norm(), 1e-6);
}

TEST(PointInCamera, IsEmptyWithoutDepth) {
  const auto frame = MakeFrameFeatures(FeaturesAt({{10, 20}}), PlainDepth(0), {});
  EXPECT_FALSE(PointInCamera(*frame, 0, {}).has_value());
}

}  // namespace
}  // namespace ofm
