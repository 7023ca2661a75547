#include "ofm/tracking/measurement.h"

#include <gtest/gtest.h>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

MeasurementModel MakeModel() { return {PinholeCamera(), test::TestScales(), {}}; }

TEST(MeasurementModel, CloseDepthIsSoManyBaselines) {
  MeasurementModel model = MakeModel();
  model.camera.baseline_m = 0.1;
  model.options.close_baselines = 30;
  EXPECT_DOUBLE_EQ(model.CloseDepth(), 3);
}

TEST(MeasurementModel, ObservesPlaceAndDepthOfTheFeature) {
  const auto frame = test::MakeTestFeatures({{{1, 2}, 3, 0, {}, 0}, {{10, 20}, 4, 0, {}, 0}});
  const PointObservation seen = MakeModel().Observe(*frame, 1);
  EXPECT_EQ(seen.ideal_px, Eigen::Vector2d(10, 20));
  EXPECT_EQ(seen.depth_m, 4);
  EXPECT_EQ(seen.weight, 1);
}

TEST(MeasurementModel, PixelNoiseGrowsWithTheOctave) {
  MeasurementModel model = MakeModel();
  model.options.pixel_sigma = 0.5;
  for (int octave = 0; octave < 8; ++octave) {
    const auto frame = test::MakeTestFeatures({{{1, 2}, 3, octave, {}, 0}});
    EXPECT_NEAR(model.Observe(*frame, 0).pixel_sigma, 0.5 * std::pow(1.2, octave), 1e-6);
  }
}

TEST(MeasurementModel, AlignedFeaturesHaveTheirOwnNoise) {
  FrameFeatures frame = *test::MakeTestFeatures({{{1, 2}, 3, 1, {}, 0}, {{5, 6}, 3, 1, {}, 0}});
  frame.aligned_noise = 0.25F;
  EXPECT_NEAR(MakeModel().Observe(frame, 1).pixel_sigma, 1.2, 1e-6);
  frame.is_aligned = {0, 1};
  EXPECT_NEAR(MakeModel().Observe(frame, 0).pixel_sigma, 1.2, 1e-6);
  EXPECT_NEAR(MakeModel().Observe(frame, 1).pixel_sigma, 0.25 * 1.2, 1e-6);
}

TEST(MeasurementModel, DepthNoiseIsThatOfTheOptions) {
  MeasurementModel model = MakeModel();
  model.options.inverse_depth_sigma = 0.0123;
  const auto frame = test::MakeTestFeatures({{{1, 2}, 3, 4, {}, 0}});
  EXPECT_EQ(model.Observe(*frame, 0).inverse_depth_sigma, 0.0123);
}

TEST(MeasurementModel, AFrameMayKnowItsDepthBetter) {
  MeasurementModel model = MakeModel();
  model.options.inverse_depth_sigma = 0.02;
  FrameFeatures frame = *test::MakeTestFeatures({{{1, 2}, 3, 4, {}, 0}});
  frame.depth_noise = 0.25F;
  EXPECT_EQ(model.Observe(frame, 0).inverse_depth_sigma, 0.005);
}

TEST(MeasurementModel, FeatureWithoutDepthStaysWithout) {
  const auto frame = test::MakeTestFeatures({{{1, 2}, 0, 0, {}, 0}});
  EXPECT_EQ(MakeModel().Observe(*frame, 0).depth_m, 0);
}

TEST(MeasurementModel, WeightIsTheStaticProbability) {
  FrameFeatures frame = *test::MakeTestFeatures({{{1, 2}, 3, 0, {}, 0}, {{5, 6}, 3, 0, {}, 0}});
  frame.static_probability = {0.25F, 0.75F};
  EXPECT_EQ(MakeModel().Observe(frame, 0).weight, 0.25);
  EXPECT_EQ(MakeModel().Observe(frame, 1).weight, 0.75);
}

}  // namespace
}  // namespace ofm
