#include "ofm/pipeline/culling_meter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::HasSubstr;

/// The left half of the image is an actor, according to the true mask in the folder; corners are in
/// four squares, one of them on the actor.
class CullingMeterTest : public testing::Test {
 protected:
  CullingMeterTest() {
    prepared_.frame.name = "1.5";
    prepared_.frame.gray = cv::Mat(120, 320, CV_8UC1, cv::Scalar(50));
    for (const int x : {60, 180, 220, 260}) {
      cv::rectangle(prepared_.frame.gray, {x, 50, 20, 20}, 220, cv::FILLED);
    }
    cv::cvtColor(prepared_.frame.gray, prepared_.frame.color, cv::COLOR_GRAY2BGR);
    prepared_.dynamic.mask = cv::Mat::zeros(prepared_.frame.gray.size(), CV_8UC1);
    prepared_.features = std::make_shared<const FrameFeatures>();
    WriteTruth({0, 0, 160, 120});
  }

  void WriteTruth(const cv::Rect& actor) const {
    cv::Mat truth = cv::Mat::zeros(prepared_.frame.gray.size(), CV_8UC1);
    truth(actor) = 3;
    cv::imwrite((folder_.path() / "1.5.png").string(), truth);
  }
  CullingMeter Meter() const { return {folder_.path(), OrbOptions{.levels = 1}}; }
  void Report(CullingMeter& meter) const {
    meter.OnFrame(FrameReport{.prepared = prepared_, .tracking = tracking_});
  }
  CullingCounts Count() const {
    CullingMeter meter = Meter();
    Report(meter);
    return meter.counts();
  }

  TestFolder folder_;
  PreparedFrame prepared_;
  TrackingResult tracking_;
};

TEST_F(CullingMeterTest, WithoutAMaskEverythingIsKept) {
  const CullingCounts counts = Count();
  EXPECT_GE(counts.actor_features, 4U) << "the corners of a square";
  EXPECT_EQ(counts.static_features, 3 * counts.actor_features) << "and of three";
  EXPECT_EQ(counts.actor_features_kept, counts.actor_features);
  EXPECT_EQ(counts.static_features_kept, counts.static_features);
  EXPECT_EQ(counts.ActorShareKept(), 1);
  EXPECT_EQ(counts.StaticShareKept(), 1);
}

TEST_F(CullingMeterTest, WhatTrulyMovesCountsAndNotWhatANetworkWouldFind) {
  const CullingCounts without = Count();
  folder_.Write("1.5.json", "[]");
  EXPECT_EQ(Count().actor_features, without.actor_features);
}

TEST_F(CullingMeterTest, EmptyMaskMasksNothing) {
  prepared_.dynamic.mask.release();
  const CullingCounts counts = Count();
  EXPECT_EQ(counts.actor_features_kept, counts.actor_features);
  EXPECT_EQ(counts.static_features_kept, counts.static_features);
}

TEST_F(CullingMeterTest, CountsWhatTheMaskTakesAway) {
  prepared_.dynamic.mask.colRange(0, 200 + 5) = 255;  // the actor's square and one of the three
  const CullingCounts counts = Count();
  EXPECT_GT(counts.actor_features, 0U);
  EXPECT_EQ(counts.actor_features_kept, 0U);
  EXPECT_EQ(3 * counts.static_features_kept, 2 * counts.static_features);
  EXPECT_EQ(counts.ActorShareKept(), 0);
  EXPECT_DOUBLE_EQ(counts.StaticShareKept(), 2.0 / 3);
}

TEST_F(CullingMeterTest, CountsTheInliersOnActors) {
  FrameFeatures features;
  // On the actor: an inlier, one that is none, one just inside. Off it: one just outside, another.
  for (const float x : {20.0F, 30.0F, 159.4F, 159.6F, 300.0F}) {
    features.keypoints.push_back({{x, 10}, 0, 0, 1});
  }
  prepared_.features = std::make_shared<const FrameFeatures>(features);
  tracking_.landmarks = {LandmarkId(7), LandmarkId(), LandmarkId(8), LandmarkId(9), LandmarkId(4)};
  const CullingCounts counts = Count();
  EXPECT_EQ(counts.actor_features_in_pose, 2U);
  EXPECT_DOUBLE_EQ(counts.ActorShareInPose(), 2.0 / static_cast<double>(counts.actor_features));
}

TEST_F(CullingMeterTest, SumsOverFrames) {
  CullingMeter meter = Meter();
  Report(meter);
  const CullingCounts once = meter.counts();
  WriteTruth({0, 0, 0, 0});
  Report(meter);
  EXPECT_EQ(meter.counts().actor_features, once.actor_features);
  EXPECT_EQ(meter.counts().static_features, 2 * once.static_features + once.actor_features);
}

TEST_F(CullingMeterTest, OfNothingNothingIsWrong) {
  const CullingCounts counts;
  EXPECT_EQ(counts.ActorShareInPose(), 0);
  EXPECT_EQ(counts.ActorShareKept(), 0);
  EXPECT_EQ(counts.StaticShareKept(), 1);
}

TEST_F(CullingMeterTest, MissingOrDamagedTruthIsAnErrorThatNamesIt) {
  EXPECT_THAT(ErrorOf([&] { CullingMeter(folder_.path() / "no-such", {}); }), HasSubstr("no-such"));
  prepared_.frame.name = "2.5";
  EXPECT_THAT(ErrorOf([&] { Count(); }), HasSubstr("2.5.png"));
  folder_.Write("2.5.png", "not an image");
  EXPECT_THAT(ErrorOf([&] { Count(); }), HasSubstr("2.5.png"));
}

}  // namespace
}  // namespace ofm
