#include "ofm/map/projection.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <tuple>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::CameraAt;
using test::FlipBits;
using test::MakeTestFeatures;
using test::TestFeature;

/// Two metres before a camera at the origin, seen along z, between 1 m and 3.58 m.
Landmark MakeLandmark() {
  Landmark landmark;
  landmark.position_in_world = {0.2, -0.1, 2};
  landmark.mean_view = Eigen::Vector3f::UnitZ();
  landmark.min_distance_m = 1;
  landmark.max_distance_m = std::pow(1.2F, 7);
  return landmark;
}

std::optional<Projection> Project(const Landmark& landmark, const RigidTransform& pose = {}) {
  return ProjectLandmark({}, pose, landmark, test::TestScales());
}

TEST(ProjectLandmark, PredictsPlaceDepthAndView) {
  const Landmark landmark = MakeLandmark();
  const auto projection = Project(landmark, CameraAt(0.1, 0, 0.5));
  ASSERT_TRUE(projection.has_value());
  EXPECT_NEAR(projection->ideal_px.x(), 319.5 + 525 * 0.1 / 1.5, 1e-9);
  EXPECT_NEAR(projection->ideal_px.y(), 239.5 - 525 * 0.1 / 1.5, 1e-9);
  EXPECT_NEAR(projection->depth_m, 1.5, 1e-12);
  EXPECT_NEAR(projection->view_cosine, 1.5 / Eigen::Vector3d(0.1, -0.1, 1.5).norm(), 1e-6);
}

TEST(ProjectLandmark, PredictsACoarserOctaveFromNearer) {
  const Landmark landmark = MakeLandmark();
  const OctaveScales scales = test::TestScales();
  for (const double depth : {1.1, 1.6, 2.2, 3.3}) {
    const auto projection = Project(landmark, CameraAt(0.2, -0.1, 2 - depth));
    ASSERT_TRUE(projection.has_value()) << depth;
    EXPECT_GE(scales.Scale(projection->octave) * depth, landmark.max_distance_m) << depth;
    EXPECT_LT(scales.Scale(projection->octave - 1) * depth, landmark.max_distance_m) << depth;
  }
}

TEST(ProjectLandmark, RefusesWhatIsBehindOrAtTheCamera) {
  Landmark landmark = MakeLandmark();
  landmark.min_distance_m = 0;
  EXPECT_TRUE(Project(landmark, CameraAt(0.2, -0.1, 1.9)));
  EXPECT_FALSE(Project(landmark, CameraAt(0.2, -0.1, 1.96))) << "nearer than 5 cm";
  EXPECT_FALSE(Project(landmark, CameraAt(0.2, -0.1, 2)));
  EXPECT_FALSE(Project(landmark, CameraAt(0.2, -0.1, 3)));
}

TEST(ProjectLandmark, RefusesWhatIsOutsideOfTheImage) {
  const Landmark landmark = MakeLandmark();
  const double half_width_m = 319.5 / 525 * 2, half_height_m = 239.5 / 525 * 2;
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(Project(landmark, CameraAt(0.2 + side * (half_width_m - 0.01), -0.1, 0)));
    EXPECT_FALSE(Project(landmark, CameraAt(0.2 + side * (half_width_m + 0.01), -0.1, 0)));
    EXPECT_TRUE(Project(landmark, CameraAt(0.2, -0.1 + side * (half_height_m - 0.01), 0)));
    EXPECT_FALSE(Project(landmark, CameraAt(0.2, -0.1 + side * (half_height_m + 0.01), 0)));
  }
}

TEST(ProjectLandmark, RefusesWhatIsOutOfTheDistanceRangeByMoreThanAFifth) {
  const Landmark landmark = MakeLandmark();
  const auto from = [&](double distance_m) {
    return Project(landmark, CameraAt(0.2, -0.1, 2 - distance_m)).has_value();
  };
  EXPECT_TRUE(from(1.2 * landmark.max_distance_m - 0.01));
  EXPECT_FALSE(from(1.2 * landmark.max_distance_m + 0.01));
  EXPECT_TRUE(from(1 / 1.2 + 0.01));
  EXPECT_FALSE(from(1 / 1.2 - 0.01));
}

TEST(ProjectLandmark, RefusesViewsOver60DegreesOffTheMean) {
  Landmark landmark = MakeLandmark();
  const auto seen = [&](double angle_deg) {
    const double angle = angle_deg * M_PI / 180;
    landmark.mean_view = Eigen::Vector3d(std::sin(angle), 0, std::cos(angle)).cast<float>();
    return Project(landmark, CameraAt(0.2, -0.1, 0)).has_value();
  };
  EXPECT_TRUE(seen(59));
  EXPECT_FALSE(seen(61));
  EXPECT_TRUE(seen(-59));
  EXPECT_FALSE(seen(180));
}

TEST(ProjectLandmark, JudgesTheViewInTheWorldsFrame) {
  // A camera to the right of the landmark that looks to the left.
  Landmark landmark = MakeLandmark();
  landmark.position_in_world = Eigen::Vector3d::Zero();
  landmark.mean_view = -Eigen::Vector3f::UnitX();
  const RigidTransform world_from_camera(ExpSo3({0, -M_PI / 2, 0}), {2, 0, 0});
  const auto projection = Project(landmark, world_from_camera.Inverse());
  ASSERT_TRUE(projection.has_value());
  EXPECT_NEAR(projection->view_cosine, 1, 1e-6);
}

// FindFeature.

FeatureQuery MakeQuery() {
  FeatureQuery query;
  query.ideal_px = {320, 240};
  query.radius_px = 10;
  query.max_octave = 7;
  return query;
}

/// A feature `bits` away from the query's descriptor.
TestFeature At(float x, float y, int bits, int octave = 0, float depth_m = 2) {
  return {{x, y}, depth_m, octave, FlipBits({}, bits), 0};
}

FeatureCandidate Find(const std::vector<TestFeature>& features, const FeatureQuery& query) {
  return FindFeature(*MakeTestFeatures(features), query, [](int) { return true; });
}

TEST(FindFeature, FindsNothingWhereNothingIs) {
  EXPECT_EQ(Find({}, MakeQuery()).feature, -1);
  EXPECT_EQ(Find({At(400, 240, 0)}, MakeQuery()).feature, -1);
  EXPECT_GT(Find({}, MakeQuery()).distance, 256) << "no gate lets it through";
}

TEST(FindFeature, GivesTheBestAndTheSecondBestInAnyOrder) {
  for (const auto& bits :
       {std::array{30, 10, 20}, std::array{10, 20, 30}, std::array{30, 20, 10}}) {
    std::vector<TestFeature> features;
    for (const int b : bits) features.push_back(At(320, 240, b));
    const FeatureCandidate found = Find(features, MakeQuery());
    ASSERT_GE(found.feature, 0);
    EXPECT_EQ(bits[found.feature], 10);
    EXPECT_EQ(found.distance, 10);
    EXPECT_EQ(found.second_distance, 20);
  }
}

TEST(FindFeature, ALoneFeatureHasNoSecond) {
  const FeatureCandidate found = Find({At(320, 240, 40)}, MakeQuery());
  EXPECT_EQ(found.distance, 40);
  EXPECT_EQ(found.second_distance, 257);
  EXPECT_FALSE(found.second_same_octave);
}

TEST(FindFeature, TellsWhetherTheSecondIsOfTheSameOctave) {
  EXPECT_TRUE(Find({At(320, 240, 10, 3), At(321, 240, 20, 3)}, MakeQuery()).second_same_octave);
  EXPECT_TRUE(Find({At(320, 240, 20, 3), At(321, 240, 10, 3)}, MakeQuery()).second_same_octave);
  EXPECT_FALSE(Find({At(320, 240, 10, 3), At(321, 240, 20, 2)}, MakeQuery()).second_same_octave);
  EXPECT_FALSE(Find({At(320, 240, 20, 2), At(321, 240, 10, 3)}, MakeQuery()).second_same_octave);
}

TEST(FindFeature, SearchesASquareOfTheRadius) {
  for (const auto& [x, y, is_near] : {std::tuple{329.5F, 230.5F, true},
                                      {310.5F, 249.5F, true},
                                      {330.5F, 240.0F, false},
                                      {309.5F, 240.0F, false},
                                      {320.0F, 250.5F, false},
                                      {320.0F, 229.5F, false}}) {
    EXPECT_EQ(Find({At(x, y, 0)}, MakeQuery()).feature >= 0, is_near) << x << ' ' << y;
  }
}

TEST(FindFeature, LooksAtTheOctavesAskedForOnly) {
  FeatureQuery query = MakeQuery();
  query.min_octave = 2;
  query.max_octave = 3;
  for (int octave = 0; octave < 8; ++octave) {
    EXPECT_EQ(Find({At(320, 240, 0, octave)}, query).feature >= 0, octave == 2 || octave == 3);
  }
}

TEST(FindFeature, ChecksDepthWhereItIsMeasuredAndAskedFor) {
  FeatureQuery query = MakeQuery();
  query.depth_m = 2;
  EXPECT_EQ(Find({At(320, 240, 0, 0, 5)}, query).feature, 0) << "not asked for";
  query.max_depth_difference_m = 0.1F;
  EXPECT_EQ(Find({At(320, 240, 0, 0, 2.2F)}, query).feature, -1);
  EXPECT_EQ(Find({At(320, 240, 0, 0, 1.8F)}, query).feature, -1);
  EXPECT_EQ(Find({At(320, 240, 0, 0, 2.05F)}, query).feature, 0);
  EXPECT_EQ(Find({At(320, 240, 0, 0, 0)}, query).feature, 0) << "not measured";
}

TEST(FindFeature, TakesOnlyWhatTheCallerAccepts) {
  const auto features = MakeTestFeatures({At(320, 240, 0), At(321, 240, 50)});
  const auto found = FindFeature(*features, MakeQuery(), [](int i) { return i != 0; });
  EXPECT_EQ(found.feature, 1);
  EXPECT_EQ(found.second_distance, 257) << "what is not accepted is no rival";
}

}  // namespace
}  // namespace ofm
