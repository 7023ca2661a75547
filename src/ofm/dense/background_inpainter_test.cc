#include "ofm/dense/background_inpainter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At;

constexpr double kSecond_ns = 1e9;

/// A view of the scene, `x` metres to the right at `second`.
std::shared_ptr<SceneView> View(const std::vector<test::Box>& boxes, double x, double second) {
  const LabelledFrame frame = test::Render(test::SmallCamera(), boxes, At(x, 0, 0), KeyframeId(0));
  return std::make_shared<SceneView>(SceneView{static_cast<std::int64_t>(second * kSecond_ns),
                                               At(x, 0, 0), At(x, 0, 0), frame.color, frame.depth_m,
                                               frame.dynamic_mask});
}

const std::vector<test::Box> kEmptyRoom = {test::Wall(), test::Chair()};

std::vector<test::Box> RoomWithPerson(double x) {
  return {test::Wall(), test::Chair(), test::Person(x)};
}

class BackgroundInpainterTest : public testing::Test {
 protected:
  InpaintedFrame Inpaint(const SceneView& target,
                         const std::vector<std::shared_ptr<SceneView>>& sources) const {
    const BackgroundInpainter inpainter(test::SmallCamera(), {}, {});
    std::vector<std::shared_ptr<const StaticView>> views;
    for (const auto& source : sources) {
      views.push_back(std::make_shared<StaticView>(inpainter.MakeStaticView(*source)));
    }
    return inpainter.Inpaint(target, views);
  }

  /// Share of the hidden pixels that were filled with the depth and colour of the empty room.
  static double ShareRight(const InpaintedFrame& frame, const SceneView& empty_room) {
    int hidden = 0, right = 0;
    for (int row = 0; row < frame.hidden.rows; ++row) {
      for (int column = 0; column < frame.hidden.cols; ++column) {
        if (frame.hidden.at<std::uint8_t>(row, column) == 0) continue;
        ++hidden;
        const cv::Vec3b difference =
            frame.color.at<cv::Vec3b>(row, column) - empty_room.color.at<cv::Vec3b>(row, column);
        right += frame.filled.at<std::uint8_t>(row, column) != 0 && difference == cv::Vec3b() &&
                 std::abs(frame.depth_m.at<float>(row, column) -
                          empty_room.depth_m.at<float>(row, column)) < .01;
      }
    }
    return static_cast<double>(right) / hidden;
  }
};

/// Colour seen at `x`, depth a moment later, the camera having gone 0.1 m on.
std::shared_ptr<SceneView> MovingView(const std::vector<test::Box>& boxes, double x,
                                      double second) {
  const auto view = View(boxes, x, second);
  view->world_from_depth = At(x + .1, 0, 0);
  view->depth_m = View(boxes, x + .1, second)->depth_m;
  return view;
}

TEST_F(BackgroundInpainterTest, FillsEachImageAsAtItsOwnTime) {
  const std::vector<std::shared_ptr<SceneView>> sources = {
      MovingView(RoomWithPerson(-.9), .05, -1), MovingView(RoomWithPerson(1.9), -.05, 1)};
  const auto target = MovingView(RoomWithPerson(.5), 0, 0);
  EXPECT_GT(ShareRight(Inpaint(*target, sources), *MovingView(kEmptyRoom, 0, 0)), .85);
}

TEST_F(BackgroundInpainterTest, ShowsWhatThePersonHid) {
  const auto target = View(RoomWithPerson(.5), 0, 0);
  const InpaintedFrame frame =
      Inpaint(*target, {View(RoomWithPerson(-.6), .05, -1), View(RoomWithPerson(1.6), -.05, 1)});
  EXPECT_GT(ShareRight(frame, *View(kEmptyRoom, 0, 0)), .85);
  cv::Mat kept_difference;
  cv::absdiff(frame.color, target->color, kept_difference);
  kept_difference.setTo(0, frame.hidden);
  EXPECT_EQ(cv::norm(kept_difference, cv::NORM_INF), 0) << "what was not hidden stays";
}

TEST_F(BackgroundInpainterTest, WhatNobodySawStaysEmpty) {
  const auto target = View(RoomWithPerson(.5), 0, 0);
  const InpaintedFrame frame = Inpaint(*target, {View(RoomWithPerson(.5), 0, 1)});
  EXPECT_LT(ShareRight(frame, *View(kEmptyRoom, 0, 0)), .3);
  const int center_row = 60, person_column = static_cast<int>(79.5 + 130 * .5 / 1.6);
  EXPECT_EQ(frame.filled.at<std::uint8_t>(center_row, person_column), 0);
  EXPECT_EQ(frame.depth_m.at<float>(center_row, person_column), 0);
}

TEST_F(BackgroundInpainterTest, APersonThatOneSourceMissedIsOutvoted) {
  const auto target = View(RoomWithPerson(.5), 0, 0);
  const auto blind = View(RoomWithPerson(.5), 0, .1);
  blind->hidden.setTo(0);
  const InpaintedFrame frame = Inpaint(
      *target,
      {View(kEmptyRoom, .05, -1), blind, View(kEmptyRoom, -.05, 1), View(kEmptyRoom, 0, 2)});
  EXPECT_GT(ShareRight(frame, *View(kEmptyRoom, 0, 0)), .85);
}

TEST_F(BackgroundInpainterTest, ADarkerSourceIsBrightened) {
  const auto target = View(RoomWithPerson(.5), 0, 0);
  const auto dark = View(kEmptyRoom, 0, 1);
  dark->color = dark->color * .6;
  const InpaintedFrame frame = Inpaint(*target, {dark});
  const cv::Vec3b truth = View(kEmptyRoom, 0, 0)->color.at<cv::Vec3b>(60, 125);
  ASSERT_NE(frame.filled.at<std::uint8_t>(60, 125), 0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(frame.color.at<cv::Vec3b>(60, 125)[i], truth[i], .05 * truth[i] + 2);
  }
}

TEST_F(BackgroundInpainterTest, WithoutAnybodyTheFrameIsUntouched) {
  const auto target = View(kEmptyRoom, 0, 0);
  const InpaintedFrame frame = Inpaint(*target, {View(kEmptyRoom, .1, 1)});
  EXPECT_EQ(cv::norm(frame.color, target->color, cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(frame.filled), 0);
}

}  // namespace
}  // namespace ofm
