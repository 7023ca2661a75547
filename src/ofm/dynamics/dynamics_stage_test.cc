#include "ofm/dynamics/dynamics_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/error.h"
#include "ofm/dynamics/test_scene.h"

namespace ofm {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kClasses = {"person", "cup"};

constexpr DynamicsMode kPaper = DynamicsMode::kPaper;

/// Believes a fundamental matrix on which half of the points agree: these scenes have many movers.
const DynamicsOptions kHalf{.mode = kPaper, .epipolar = {.min_inlier_share = 0.5}};

/// Modes `off` and `paper`; `full` has its own tests.
class DynamicsStageTest : public ::testing::Test {
 protected:
  DynamicsStageTest() { frame_.gray = cv::Mat::zeros(480, 640, CV_8UC1); }

  DynamicsStage Stage(const DynamicsOptions& options = {}) const {
    return DynamicsStage(options, scene_.camera, kClasses);
  }
  DynamicMask Process(const FlowResult& flow, const DynamicsOptions& options = kHalf) const {
    return Stage(options).Process({frame_, segmentation_, flow, {}});
  }
  void AddInstance(std::uint32_t class_id, const cv::Rect& box) {
    Instance instance{InstanceId(0), ClassId(class_id), 0.9F, box,
                      cv::Mat::zeros(480, 640, CV_8UC1)};
    instance.mask(box).setTo(255);
    segmentation_.instances.push_back(instance);
  }
  /// How many of the mover's tracked points were found moving, and how many others.
  struct Found {
    double share_of_mover = 0;
    int static_points = 0;
  };
  Found Compare(const FlowResult& flow, const DynamicMask& mask) const {
    int mover = 0, tracked_on_mover = 0;
    const auto static_count = static_cast<std::size_t>(scene_.static_count);
    for (std::size_t i = static_count; i < flow.size(); ++i) tracked_on_mover += flow.IsTracked(i);
    for (const Eigen::Vector2f& point : mask.dynamic_points) {
      const auto found = std::find(flow.current.begin(), flow.current.end(), point);
      mover += found - flow.current.begin() >= static_cast<std::ptrdiff_t>(static_count);
    }
    return {mover / static_cast<double>(std::max(1, tracked_on_mover)),
            static_cast<int>(mask.dynamic_points.size()) - mover};
  }

  test::Scene scene_;
  RgbdFrame frame_;
  Segmentation segmentation_;
};

TEST_F(DynamicsStageTest, OffMeansNothingIsMasked) {
  AddInstance(0, {100, 100, 50, 50});
  scene_.mover_count = 100;
  const DynamicMask mask =
      Process(scene_.Flow({.mover_shift_m = {0, 0.08, 0}}, 1), {.mode = DynamicsMode::kOff});
  EXPECT_EQ(mask.mask.size(), cv::Size(640, 480));
  EXPECT_EQ(cv::countNonZero(mask.mask), 0);
  EXPECT_EQ(mask.masked_share, 0);
  EXPECT_THAT(mask.dynamic_points, IsEmpty());
}

TEST_F(DynamicsStageTest, PeopleAreMaskedWithAMargin) {
  AddInstance(0, {100, 100, 50, 60});
  const DynamicMask mask = Process({}, {.mode = kPaper, .dilation_px = 5});
  cv::Mat expected;
  cv::dilate(segmentation_.instances[0].mask, expected,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(11, 11)));
  EXPECT_EQ(cv::countNonZero(mask.mask != expected), 0);
  EXPECT_NEAR(mask.masked_share, cv::countNonZero(expected) / (640.0 * 480), 1e-12);
  EXPECT_GT(mask.masked_share, 50 * 60 / (640.0 * 480));
}

TEST_F(DynamicsStageTest, OtherClassesAreLeft) {
  AddInstance(1, {100, 100, 50, 60});
  EXPECT_EQ(cv::countNonZero(Process({}).mask), 0);
  EXPECT_GT(
      cv::countNonZero(Process({}, {.mode = kPaper, .dynamic_classes = {"person", "cup"}}).mask),
      50 * 60);
}

TEST_F(DynamicsStageTest, MisspeltClassIsRefusedUnlessThereIsNoNetwork) {
  const DynamicsOptions options{.dynamic_classes = {"preson"}};
  try {
    DynamicsStage(options, scene_.camera, kClasses);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("knows no class 'preson'; it has person, cup"));
  }
  EXPECT_NO_THROW(DynamicsStage(options, scene_.camera, {}));
}

TEST_F(DynamicsStageTest, CameraMotionAloneMovesNoPoint) {
  const test::Motion motions[] = {
      {},
      {.camera_shift_m = {0, 0, 0.1}, .camera_turn_rad = {0, 0, 0}},
      {.camera_shift_m = {0, 0, 0}, .camera_turn_rad = {0.01, 0.05, -0.03}},  // turns in place
      {.camera_shift_m = {0, 0, 0}, .camera_turn_rad = {0, 0, 0}},            // stands still
  };
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const test::Motion& motion : motions) {
      EXPECT_THAT(Process(scene_.Flow(motion, seed)).dynamic_points, IsEmpty());
    }
  }
}

/// The camera moves to the side, the board upwards, across its epipolar lines: 7 cm at 1.5 m are 24
/// px.
TEST_F(DynamicsStageTest, PointsOnAMoverAreFoundAndNoOthers) {
  scene_.mover_count = 100;
  const test::Motion motion{.camera_shift_m = {0.05, 0, 0}, .mover_shift_m = {0, -0.07, 0}};
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const FlowResult flow = scene_.Flow(motion, seed);
    const DynamicMask mask = Process(flow);
    const Found found = Compare(flow, mask);
    EXPECT_GT(found.share_of_mover, 0.95);
    EXPECT_LE(found.static_points, 4);
    for (const Eigen::Vector2f& point : mask.dynamic_points) {
      EXPECT_EQ(mask.mask.at<std::uint8_t>(
                    cv::Point(static_cast<int>(point.x()), static_cast<int>(point.y()))),
                255);
    }
  }
}

TEST_F(DynamicsStageTest, MotionUnderTheThresholdIsLeft) {
  scene_.mover_count = 100;
  const test::Motion motion{.camera_shift_m = {0.05, 0, 0}, .mover_shift_m = {0, -0.012, 0}};
  const FlowResult flow = scene_.Flow(motion, 1);  // 4 px
  EXPECT_THAT(Process(flow).dynamic_points, IsEmpty());
  const DynamicsOptions sharper{.mode = kPaper,
                                .epipolar = {.threshold_px = 2, .min_inlier_share = 0.5}};
  EXPECT_GT(Compare(flow, Process(flow, sharper)).share_of_mover, 0.95);
}

/// Two thirds of the points are on the mover: without the mask they would be taken for the world.
TEST_F(DynamicsStageTest, WorldIsFittedToPointsOffThePeople) {
  scene_.static_count = 200;
  scene_.mover_count = 400;
  const test::Motion motion{.camera_shift_m = {0.05, 0, 0}, .mover_shift_m = {0, -0.07, 0}};
  const FlowResult flow = scene_.Flow(motion, 1);
  EXPECT_LT(Compare(flow, Process(flow)).share_of_mover, 0.5);
  AddInstance(0, {80, 60, 240, 380});
  EXPECT_GT(Compare(flow, Process(flow)).share_of_mover, 0.95);
}

TEST_F(DynamicsStageTest, FlowIsIgnoredWhereTooFewPointsAreOffThePeople) {
  scene_.mover_count = 100;
  const FlowResult flow = scene_.Flow({.mover_shift_m = {0, -0.07, 0}}, 1);
  AddInstance(0, {0, 0, 640, 470});
  const DynamicMask mask = Process(flow);
  EXPECT_THAT(mask.dynamic_points, IsEmpty());
  EXPECT_GT(mask.masked_share, 0.97);
}

TEST_F(DynamicsStageTest, FlowIsIgnoredWhereNoMotionExplainsTheMostOfIt) {
  const FlowResult flow = scene_.Flow({.noise_px = 30}, 1);
  EXPECT_THAT(Process(flow).dynamic_points, IsEmpty());
  const DynamicsOptions trusting{.mode = kPaper, .epipolar = {.min_inlier_share = 0}};
  EXPECT_GT(Process(flow, trusting).dynamic_points.size(), 50U);
}

TEST_F(DynamicsStageTest, PointsThatWereNotTrackedSayNothing) {
  scene_.mover_count = 100;
  FlowResult flow =
      scene_.Flow({.camera_shift_m = {0.05, 0, 0}, .mover_shift_m = {0, -0.07, 0}}, 1);
  for (std::size_t i = 400; i < flow.size(); ++i) flow.status[i] = FlowStatus::kInconsistent;
  EXPECT_EQ(Compare(flow, Process(flow)).share_of_mover, 0);
}

TEST_F(DynamicsStageTest, DiscsHaveTheRadiusAskedForAndMayReachOverTheBorder) {
  FlowResult flow = scene_.Flow({.camera_shift_m = {0.05, 0, 0}}, 1);
  for (const Eigen::Vector2f& now : {Eigen::Vector2f(300, 200), Eigen::Vector2f(639, 0)}) {
    flow.previous.push_back(now + Eigen::Vector2f(0, 20));
    flow.current.push_back(now);
    flow.status.push_back(FlowStatus::kTracked);
  }
  const DynamicMask mask = Process(flow, {.mode = kPaper, .exclusion_radius_px = 8});
  ASSERT_EQ(mask.dynamic_points.size(), 2U);
  EXPECT_EQ(mask.mask.at<std::uint8_t>(200, 308), 255);
  EXPECT_EQ(mask.mask.at<std::uint8_t>(200, 310), 0);
  EXPECT_EQ(mask.mask.at<std::uint8_t>(0, 639), 255);
  EXPECT_NEAR(cv::countNonZero(mask.mask), 1.25 * 3.14159 * 8 * 8, 45);
}

TEST_F(DynamicsStageTest, SameInputGivesTheSameMask) {
  scene_.mover_count = 200;
  AddInstance(0, {300, 100, 80, 200});
  const FlowResult flow = scene_.Flow({.mover_shift_m = {0, -0.07, 0}}, 3);
  const DynamicMask a = Process(flow), b = Process(flow);
  EXPECT_EQ(a.dynamic_points, b.dynamic_points);
  EXPECT_EQ(cv::countNonZero(a.mask != b.mask), 0);
}

TEST(DynamicsOptions, ModeAndClassesAreReadByName) {
  DynamicsOptions options;
  ApplyOptionAssignment("mode=off", OptionFields(options));
  ApplyOptionAssignment("dynamic_classes=[person, dog]", OptionFields(options));
  EXPECT_EQ(options.mode, DynamicsMode::kOff);
  EXPECT_EQ(options.dynamic_classes, (std::vector<std::string>{"person", "dog"}));
  EXPECT_THROW(ApplyOptionAssignment("mode=paper-like", OptionFields(options)), Error);
}

}  // namespace
}  // namespace ofm
