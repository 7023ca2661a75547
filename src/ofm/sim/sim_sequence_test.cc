#include "ofm/sim/sim_sequence.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <stdexcept>

#include "ofm/base/time.h"

namespace ofm {
namespace {

SimSequenceOptions SmallSequence() {
  SimSequenceOptions options;
  options.frames = 5;
  options.camera = MakeSimCamera(160, 120);
  options.room.people = 2;
  options.noise.model = NoiseModel::kKinect;
  return options;
}

bool SameImages(const RgbdFrame& a, const RgbdFrame& b) {
  return cv::norm(a.color, b.color, cv::NORM_INF) == 0 &&
         cv::norm(a.depth_m, b.depth_m, cv::NORM_INF) == 0 &&
         cv::norm(a.gray, b.gray, cv::NORM_INF) == 0;
}

TEST(SimSequence, GivesItsFramesInOrderAndThenNone) {
  SimSequence sequence(SmallSequence());
  EXPECT_EQ(sequence.size(), 5U);
  std::int64_t last_ns = 0;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::optional<RgbdFrame> frame = sequence.Next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->id, FrameId(i));
    EXPECT_GT(frame->stamp_ns, last_ns);
    EXPECT_EQ(frame->stamp_ns, sequence.StampNs(frame->id));
    EXPECT_EQ(frame->depth_stamp_ns, frame->stamp_ns);
    EXPECT_EQ(frame->color.type(), CV_8UC3);
    EXPECT_EQ(frame->gray.type(), CV_8UC1);
    EXPECT_EQ(frame->depth_m.type(), CV_32FC1);
    EXPECT_EQ(frame->depth_m.size(), cv::Size(160, 120));
    last_ns = frame->stamp_ns;
  }
  EXPECT_FALSE(sequence.Next());
  sequence.Rewind();
  EXPECT_EQ(sequence.Next()->id, FrameId(0));
}

TEST(SimSequence, SameSeedGivesTheSameBytes) {
  SimSequence a(SmallSequence()), b(SmallSequence());
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(SameImages(*a.Next(), *b.Next())) << i;
}

TEST(SimSequence, AnotherSeedGivesAnotherWorld) {
  SimSequenceOptions options = SmallSequence();
  const SimSequence a(options);
  options.seed = 2;
  const SimSequence b(options);
  const RgbdFrame frame_a = a.Frame(FrameId(0)), frame_b = b.Frame(FrameId(0));
  EXPECT_GT(cv::norm(frame_a.gray, frame_b.gray, cv::NORM_L1) / frame_a.gray.total(), 15);
}

TEST(SimSequence, FrameDoesNotDependOnWhatWasAskedBefore) {
  SimSequence sequence(SmallSequence());
  const RgbdFrame last = sequence.Frame(FrameId(4));
  for (int i = 0; i < 4; ++i) sequence.Next();
  EXPECT_TRUE(SameImages(*sequence.Next(), last));
}

TEST(SimSequence, StampsAreWholeMicrosecondsAtTheRate) {
  const SimSequence sequence(SmallSequence());
  EXPECT_EQ(sequence.StampNs(FrameId(0)), 1000 * kNanosecondsPerSecond);
  EXPECT_EQ(sequence.StampNs(FrameId(1)), 1000'033'333'000);
  EXPECT_EQ(sequence.StampNs(FrameId(3)), 1000'100'000'000);
  EXPECT_NEAR(sequence.SceneTime(FrameId(3)), 0.1, 1e-12);
  EXPECT_EQ(sequence.Frame(FrameId(1)).name, "1000.033333");
  EXPECT_THROW(sequence.StampNs(FrameId(5)), std::logic_error);
}

TEST(SimSequence, TruthHasThePoseOfEveryFrame) {
  const SimSequence sequence(SmallSequence());
  const Trajectory truth = sequence.GroundTruth();
  ASSERT_EQ(truth.size(), 5U);
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(truth[i].stamp_ns, sequence.StampNs(FrameId(i)));
    EXPECT_EQ(truth[i].world_from_camera.translation(),
              sequence.WorldFromCamera(FrameId(i)).translation());
  }
  EXPECT_GT(
      (truth[4].world_from_camera.translation() - truth[0].world_from_camera.translation()).norm(),
      0.05);
}

TEST(SimSequence, MoverMaskHoldsThePeopleAloneAndTheyAreInFront) {
  const SimSequence sequence(SmallSequence());
  const cv::Mat all = sequence.InstanceMask(FrameId(2));
  const cv::Mat movers = sequence.MoverMask(FrameId(2));
  double most;
  cv::minMaxLoc(movers, nullptr, &most);
  EXPECT_LE(most, 2);
  cv::minMaxLoc(all, nullptr, &most);
  EXPECT_GT(most, 2) << "furniture";
  EXPECT_EQ(cv::countNonZero((movers > 0) & (movers != all)), 0);
  ASSERT_GT(cv::countNonZero(movers), 1000);
  const cv::Mat depth_m = sequence.Frame(FrameId(2)).depth_m;
  const cv::Mat measured = (movers > 0) & (depth_m > 0);
  EXPECT_LT(cv::mean(depth_m, measured)[0], cv::mean(depth_m, (movers == 0) & (depth_m > 0))[0]);
}

TEST(SimSequence, WithoutPeopleThereIsNoMover) {
  SimSequenceOptions options = SmallSequence();
  options.room.people = 0;
  const SimSequence sequence(options);
  EXPECT_EQ(cv::countNonZero(sequence.MoverMask(FrameId(0))), 0);
}

TEST(SimSequence, DepthIsThatOfTheTrueSurfaces) {
  SimSequenceOptions options = SmallSequence();
  options.noise.model = NoiseModel::kNone;
  options.room.people = 0;
  const SimSequence sequence(options);
  const RgbdFrame frame = sequence.Frame(FrameId(3));
  const RigidTransform world_from_camera = sequence.WorldFromCamera(FrameId(3));
  // The upper corners see the ceiling, at z = 2.6 m, or the wall, at y = 2.5 m.
  for (const int column : {0, 60, 159}) {
    const Eigen::Vector3d point =
        world_from_camera *
        sequence.camera().UnprojectIdeal({double(column), 0.0}, frame.depth_m.at<float>(0, column));
    const double off = std::min(std::abs(point.z() - 2.6), std::abs(point.y() - 2.5));
    EXPECT_LT(off, 1e-4) << point.transpose();
  }
}

TEST(SimSequence, OptionsAreReadByName) {
  SimSequenceOptions options;
  const std::vector<OptionField> fields = OptionFields(options);
  ApplyOptionAssignment("path.kind=tour", fields);
  ApplyOptionAssignment("room.people=3", fields);
  ApplyOptionAssignment("noise.model=kinect", fields);
  ApplyOptionAssignment("seed=42", fields);
  EXPECT_EQ(options.path.kind, CameraPathKind::kTour);
  EXPECT_EQ(options.room.people, 3);
  EXPECT_EQ(options.noise.model, NoiseModel::kKinect);
  EXPECT_EQ(options.seed, 42U);
}

TEST(MakeSimCamera, SeesAsWideAtEverySize) {
  const PinholeCamera small = MakeSimCamera(160, 120), large = MakeSimCamera(640, 480);
  EXPECT_NEAR(small.fx / small.width, large.fx / large.width, 1e-12);
  EXPECT_EQ(large.cx, 319.5);
  EXPECT_EQ(small.cy, 59.5);
}

}  // namespace
}  // namespace ofm
