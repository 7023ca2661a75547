#include "ofm/dense/keyframe_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "ofm/base/error.h"
#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::Chair, test::Person, test::Render, test::SmallCamera, test::Wall;

KeyframeCloud MakeCloud(const std::vector<test::Box>& boxes, const DenseOptions& options = {}) {
  const LabelledFrame frame = Render(SmallCamera(), boxes, RigidTransform(), KeyframeId(0));
  return KeyframeCloudMaker(SmallCamera(), options).Make(frame);
}

TEST(KeyframeCloud, AWallIsFlatThroughADistortedLens) {
  PinholeCamera camera = SmallCamera();
  camera.k1 = .26, camera.k2 = -.9, camera.p1 = -.005;
  const LabelledFrame frame = Render(camera, {Wall(), Chair()}, RigidTransform(), KeyframeId(0));
  const KeyframeCloud cloud = KeyframeCloudMaker(camera, {}).Make(frame);
  ASSERT_GT(cloud.points_in_camera.size(), 1000u);
  double chair_left = 1e9;
  for (const LabelledPoint& point : cloud.points_in_camera) {
    const bool on_chair = point.class_id == test::kChair;
    EXPECT_NEAR(point.position.z(), on_chair ? 2.02 : 3.02, 1e-4);
    if (on_chair) chair_left = std::min<double>(chair_left, point.position.x());
  }
  // Its true left side, but for the rim of two pixels that goes; undistorted it would be off by
  // more.
  EXPECT_NEAR(chair_left, .4 + .025, .02);
}

TEST(KeyframeCloud, ColorsAndLabelsAreThoseOfTheSurface) {
  int chair = 0, wall = 0;
  for (const LabelledPoint& point : MakeCloud({Wall(), Chair()}).points_in_camera) {
    const bool on_chair = point.position.z() < 2.5;
    EXPECT_EQ(point.class_id, on_chair ? test::kChair : kNoLabel);
    EXPECT_EQ(point.color, on_chair ? test::kRed : test::kGrey);
    EXPECT_EQ(point.confidence, on_chair ? 230 : 128);
    ++(on_chair ? chair : wall);
  }
  EXPECT_GT(chair, 100);
  EXPECT_GT(wall, 1000);
}

TEST(KeyframeCloud, PointsKnowTheirInstanceAndHowPreciseTheirDepthIs) {
  LabelledFrame frame = Render(SmallCamera(), {Wall(), Chair()}, RigidTransform(), KeyframeId(0));
  frame.instances = cv::Mat(frame.depth_m.size(), CV_16UC1, cv::Scalar(kNoInstance));
  frame.instances.setTo(3, frame.class_ids == test::kChair);
  for (const LabelledPoint& point :
       KeyframeCloudMaker(SmallCamera(), {}).Make(frame).points_in_camera) {
    const bool on_chair = point.class_id == test::kChair;
    EXPECT_EQ(point.instance, on_chair ? 3 : kNoInstance);
    const double sigma_m = 1.4e-3 * (on_chair ? 2.02 * 2.02 : 3.02 * 3.02);
    EXPECT_NEAR(1 / std::sqrt(point.precision), sigma_m, 1e-5);
  }
}

TEST(KeyframeCloud, ThereIsOnePointPerVoxel) {
  DenseOptions coarse;
  coarse.resolution_m = .4;
  const std::size_t fine_points = MakeCloud({Wall()}).points_in_camera.size();
  const std::size_t coarse_points = MakeCloud({Wall()}, coarse).points_in_camera.size();
  // 3.7 m x 2.8 m of wall in squares of .2 m.
  EXPECT_NEAR(static_cast<double>(coarse_points), 3.7 * 2.8 / .04, 40);
  EXPECT_GT(fine_points, 10 * coarse_points);
}

TEST(KeyframeCloud, NothingOfWhatMovesIsKept) {
  const KeyframeCloud cloud = MakeCloud({Wall(), Chair(), Person(-.2)});
  EXPECT_GT(cloud.points_in_camera.size(), 1000u);
  for (const LabelledPoint& point : cloud.points_in_camera) {
    EXPECT_GT(point.position.z(), 1.9);
    EXPECT_NE(point.class_id, test::kPerson);
  }
}

TEST(KeyframeCloud, PointsBeyondTheRangeOnlyFree) {
  DenseOptions options;
  options.range_m = 2.5;
  const KeyframeCloud cloud = MakeCloud({Wall(), Chair()}, options);
  ASSERT_FALSE(cloud.points_in_camera.empty());
  for (const LabelledPoint& point : cloud.points_in_camera) {
    EXPECT_LE(point.position.norm(), 2.5);
    EXPECT_EQ(point.class_id, test::kChair);
  }
  ASSERT_GT(cloud.free_ends_in_camera.size(), 200u);
  for (const Eigen::Vector3f& end : cloud.free_ends_in_camera) EXPECT_NEAR(end.norm(), 2.5, .01);
}

/// The same with every second pixel of every second row.
LabelledFrame Coarse(LabelledFrame frame) {
  for (cv::Mat* image :
       {&frame.color, &frame.depth_m, &frame.class_ids, &frame.confidence, &frame.dynamic_mask}) {
    cv::resize(*image, *image, {image->cols / 2, image->rows / 2}, 0, 0, cv::INTER_NEAREST);
  }
  return frame;
}

/// Points of the wall behind the place of Person(0).
std::ptrdiff_t CountBehindPerson(const KeyframeCloud& cloud) {
  return std::ranges::count_if(cloud.points_in_camera, [](const LabelledPoint& point) {
    return point.position.z() > 2.9 && std::abs(point.position.x()) < .3 &&
           std::abs(point.position.y()) < .8;
  });
}

TEST(KeyframeCloud, ViewsAddWhatIsHiddenInTheKeyframe) {
  const KeyframeCloudMaker maker(SmallCamera(), {});
  const LabelledFrame keyframe =
      Render(SmallCamera(), {Wall(), Person(0)}, RigidTransform(), KeyframeId(0));
  EXPECT_EQ(CountBehindPerson(maker.Make(keyframe)), 0);
  const RigidTransform keyframe_from_view = test::At(.2, .1, -.3);
  LabelledFrame view =
      Coarse(Render(SmallCamera(), {Wall(), Person(2)}, keyframe_from_view, KeyframeId()));
  view.keyframe_from_depth = keyframe_from_view;
  const KeyframeCloud cloud = maker.Make(keyframe, std::span(&view, 1));
  EXPECT_GT(CountBehindPerson(cloud), 200);
  for (const LabelledPoint& point : cloud.points_in_camera) {
    ASSERT_NEAR(point.position.z(), 3.02, 1e-4);
  }
}

TEST(KeyframeCloud, TellsWhichFramesShowedAPointAndWhatMoves) {
  std::vector<LabelledFrame> frames;
  for (int i = 0; i < 3; ++i) {
    std::vector<test::Box> boxes{Wall(), Person(.5 * i)};
    if (i == 2) boxes.push_back({{-.9, -.3, 2.02}, {-.5, .3, 2.3}, test::kRed});
    frames.push_back(Render(SmallCamera(), boxes, {}, KeyframeId(0)));
    frames.back().stamp_ns = 100 * i;
    if (i > 0) frames.back() = Coarse(frames.back());
  }
  const std::span all(frames);
  const KeyframeCloud cloud = KeyframeCloudMaker(SmallCamera(), {}).Make(all[0], all.subspan(1));
  EXPECT_EQ(cloud.stamps_ns, (std::vector<std::int64_t>{0, 100, 200}));
  ASSERT_EQ(cloud.seen_in.size(), cloud.points_in_camera.size());
  FrameBits all_points = 0;
  for (std::size_t i = 0; i < cloud.seen_in.size(); ++i) {
    ASSERT_NE(cloud.seen_in[i], 0u);
    all_points |= cloud.seen_in[i];
    if (cloud.points_in_camera[i].position.z() < 2.5) {
      EXPECT_EQ(cloud.seen_in[i], 4u);
    }
  }
  EXPECT_EQ(all_points, 7u);
  ASSERT_GT(cloud.movers_in_camera.size(), 100u);
  for (const MoverPoint& mover : cloud.movers_in_camera) {
    EXPECT_NEAR(mover.position.z(), 1.52, .03);
    const double x = mover.position.x();  // half a metre further right in each frame
    EXPECT_EQ(mover.seen_in, x < .25 ? 1u : x < .75 ? 2u : 4u) << x;
  }
}

TEST(KeyframeCloud, MoreFramesThanBitsShareTheLastOne) {
  std::vector<LabelledFrame> frames;
  for (int i = 0; i < 40; ++i) {
    frames.push_back(Render(SmallCamera(), {Wall()}, {}, KeyframeId(0)));
    frames.back().stamp_ns = i;
  }
  const std::span all(frames);
  const KeyframeCloud cloud = KeyframeCloudMaker(SmallCamera(), {}).Make(all[0], all.subspan(1));
  EXPECT_EQ(cloud.stamps_ns.size(), 32u);
  EXPECT_EQ(cloud.seen_in.front(), ~FrameBits{0});
}

TEST(KeyframeCloud, TellsWhatWasSeenOffTheBorderWhereThereAreMasks) {
  DenseOptions options;
  options.passing.border_share = .1;
  const KeyframeCloudMaker maker(SmallCamera(), options);
  LabelledFrame frame = Render(SmallCamera(), {Wall()}, RigidTransform(), KeyframeId(0));
  const KeyframeCloud cloud = maker.Make(frame);
  ASSERT_EQ(cloud.off_border.size(), cloud.points_in_camera.size());
  for (std::size_t i = 0; i < cloud.off_border.size(); ++i) {
    const Eigen::Vector2f px = 130 * cloud.points_in_camera[i].position.head<2>() / 3.02f;
    const double inside_px = std::min(63.5 - std::abs(px.x()), 43.5 - std::abs(px.y()));
    if (std::abs(inside_px) > 1.5) {
      EXPECT_EQ(cloud.off_border[i], inside_px > 0) << px;
    }
  }
  frame.dynamic_mask = cv::Mat();
  EXPECT_TRUE(std::ranges::all_of(maker.Make(frame).off_border, [](int is_off) { return is_off; }));
}

TEST(KeyframeCloud, ASpanReachesFromTheFirstFrameOfASetToTheLast) {
  KeyframeCloud cloud;
  cloud.stamps_ns = {900'000'000, 100'000'000, 400'000'000};  // the key frame is the last in time
  EXPECT_DOUBLE_EQ(cloud.SpanOf(0b111).Seconds(), .8);
  EXPECT_DOUBLE_EQ(cloud.SpanOf(0b110).Seconds(), .3);
  EXPECT_EQ(cloud.SpanOf(0b100).Seconds(), 0);
  EXPECT_EQ(cloud.SpanOf(0).Seconds(), 0);
}

TEST(KeyframeCloud, LiesWhereTheCameraWasWhenItsDepthWasTaken) {
  const RigidTransform color_from_depth = test::At(.03, 0, .05);
  LabelledFrame frame = Render(SmallCamera(), {Wall(), Chair()}, color_from_depth, KeyframeId(0));
  frame.keyframe_from_depth = color_from_depth;
  const KeyframeCloud cloud = KeyframeCloudMaker(SmallCamera(), {}).Make(frame);
  ASSERT_GT(cloud.points_in_camera.size(), 1000u);
  for (const LabelledPoint& point : cloud.points_in_camera) {
    EXPECT_NEAR(point.position.z(), point.class_id == test::kChair ? 2.02 : 3.02, 1e-4);
  }
}

TEST(KeyframeCloud, WithoutDepthOrLabelsThereIsStillACloud) {
  LabelledFrame frame = Render(SmallCamera(), {Wall()}, RigidTransform(), KeyframeId(0));
  frame.class_ids = frame.confidence = frame.dynamic_mask = cv::Mat();
  const KeyframeCloudMaker maker(SmallCamera(), {});
  EXPECT_GT(maker.Make(frame).points_in_camera.size(), 1000u);
  frame.depth_m = cv::Scalar(0);
  EXPECT_TRUE(maker.Make(frame).points_in_camera.empty());
}

TEST(KeyframeCloud, ImagesOfAWrongSizeOrTypeAreAProgrammersError) {
  const KeyframeCloudMaker maker(SmallCamera(), {});
  const LabelledFrame good = Render(SmallCamera(), {Wall()}, RigidTransform(), KeyframeId(0));
  LabelledFrame bad = good;
  bad.depth_m = good.depth_m.rowRange(0, 60);
  EXPECT_THROW(maker.Make(bad), std::logic_error);
  bad = good;
  bad.color = good.class_ids;
  EXPECT_THROW(maker.Make(bad), std::logic_error);
  bad = good;
  bad.confidence = cv::Mat();
  EXPECT_THROW(maker.Make(bad), std::logic_error);
}

TEST(KeyframeCloud, AResolutionOfNothingIsAnError) {
  DenseOptions options;
  options.resolution_m = 0;
  EXPECT_THROW(KeyframeCloudMaker(SmallCamera(), options), Error);
}

}  // namespace
}  // namespace ofm
