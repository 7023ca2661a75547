#include "ofm/pipeline/debug_view.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace ofm {
namespace {

constexpr int kWidth = 160, kHeight = 120;

/// A grey frame with one dynamic instance, one feature in the pose and one that is not.
struct Scene {
  PreparedFrame prepared;
  TrackingResult tracking;

  Scene() {
    prepared.frame.id = FrameId(7);
    prepared.frame.color = cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(100));
    cv::Mat mask = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
    const cv::Rect box(40, 30, 50, 60);
    mask(box).setTo(255);
    prepared.dynamic.mask = mask;
    prepared.segmentation.instances.push_back({InstanceId(1), ClassId(0), 0.9F, box, mask});
    auto features = std::make_shared<FrameFeatures>();
    for (const float x : {120.0F, 140.0F}) {
      Keypoint keypoint;
      keypoint.pixel = {x, 100};
      features->keypoints.push_back(keypoint);
    }
    prepared.features = features;
    tracking.status = TrackingStatus::kTracked;
    tracking.landmarks = {LandmarkId(3), LandmarkId()};
  }

  cv::Mat Draw() const { return DrawDebugView({prepared, tracking}, {"person"}); }
};

cv::Vec3b At(const cv::Mat& view, int x, int y) { return view.at<cv::Vec3b>(y, x); }

TEST(DebugView, IsFourPicturesOfTheFramesSize) {
  const cv::Mat view = Scene().Draw();
  EXPECT_EQ(view.size(), cv::Size(2 * kWidth, 2 * kHeight));
  EXPECT_EQ(view.type(), CV_8UC3);
}

TEST(DebugView, WhatIsDynamicIsRedAtTheLeftAndBlackAtTheRight) {
  const cv::Mat view = Scene().Draw();
  const cv::Vec3b tinted = At(view, 80, 80), cut = At(view, kWidth + 80, 80);
  EXPECT_GT(tinted[2], tinted[0] + 50);
  EXPECT_EQ(cut, cv::Vec3b(0, 0, 0));
  EXPECT_EQ(At(view, kWidth + 10, 10), cv::Vec3b(100, 100, 100));
}

TEST(DebugView, FeaturesInThePoseAreGreenAndOthersBlue) {
  const cv::Mat view = Scene().Draw();
  const cv::Vec3b used = At(view, kWidth + 120, kHeight + 100);
  const cv::Vec3b unused = At(view, kWidth + 140, kHeight + 100);
  EXPECT_GT(used[1], 200);
  EXPECT_EQ(used[2], 0);
  EXPECT_GT(unused[0], 200);
}

TEST(DebugView, FlowIsDrawnAndWhatMovesIsRed) {
  Scene scene;
  scene.prepared.dynamic.flow = {{{20, 20}, {30, 20}, false}, {{20, 60}, {30, 60}, true}};
  const cv::Mat view = scene.Draw();
  EXPECT_GT(At(view, 30, kHeight + 20)[1], 200);
  EXPECT_GT(At(view, 30, kHeight + 60)[2], 200);
}

TEST(DebugView, AFrameThatNothingWasFoundInIsDrawnToo) {
  Scene scene;
  scene.prepared.dynamic = {};
  scene.prepared.segmentation = {};
  scene.prepared.features = std::make_shared<FrameFeatures>();
  scene.tracking = {};
  EXPECT_EQ(At(scene.Draw(), kWidth + 80, 80), cv::Vec3b(100, 100, 100));
}

TEST(DebugView, TheFrameItselfIsNotTouched) {
  const Scene scene;
  const cv::Mat before = scene.prepared.frame.color.clone();
  scene.Draw();
  EXPECT_EQ(cv::norm(before, scene.prepared.frame.color, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace ofm
