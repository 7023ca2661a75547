#include "ofm/pipeline/view_collector.h"

#include <gtest/gtest.h>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::CameraAt;

constexpr int kWidth = 8, kHeight = 6;

/// Grey, at 2 m, but for the last column, where an instance of class 3 moves.
PreparedFrame MakeFrame() {
  PreparedFrame prepared;
  prepared.frame.stamp_ns = 33;
  prepared.frame.color = cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(90));
  prepared.frame.depth_m = cv::Mat(kHeight, kWidth, CV_32FC1, cv::Scalar(2));
  const cv::Rect box(6, 0, 2, kHeight);
  cv::Mat mask = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
  mask(box).setTo(255);
  prepared.dynamic.mask = mask;
  prepared.segmentation.instances.push_back({InstanceId(1), ClassId(3), 1, box, mask});
  return prepared;
}

/// Two keyframes one metre apart, each in a sub-map of its own.
class ViewCollectorTest : public testing::Test {
 protected:
  ViewCollectorTest() {
    for (int x = 0; x < 2; ++x) {
      Keyframe keyframe = test::MakePlainKeyframe(3, CameraAt(x, 0, 0));
      keyframe.submap = SubmapId();
      map_.AddKeyframe(std::move(keyframe));
    }
  }

  /// Of a camera 0.1 m to the right of the reference, whose depth image shows it 0.02 m further.
  static TrackingResult Tracked(std::uint32_t reference = 0) {
    TrackingResult result;
    result.status = TrackingStatus::kTracked;
    result.reference = KeyframeId(reference);
    result.camera_from_reference = CameraAt(.1, 0, 0);
    result.depth_from_color = CameraAt(.02, 0, 0);
    return result;
  }
  /// Of a keyframe 0.5 m to the right of the first.
  static KeyframeCandidate Candidate() {
    KeyframeCandidate candidate;
    candidate.reference = KeyframeId(0);
    candidate.camera_from_world = CameraAt(.5, 0, 0);
    return candidate;
  }
  std::vector<LabelledFrame> Take(ViewCollector& collector) {
    return collector.Take(Candidate(), *map_.Snapshot());
  }

  Map map_{test::TestScales()};
};

TEST_F(ViewCollectorTest, ViewsKnowWhereTheyLieFromTheKeyframe) {
  ViewCollector collector(1);
  collector.Add(MakeFrame(), Tracked());
  const std::vector<LabelledFrame> views = Take(collector);
  ASSERT_EQ(views.size(), 1U);
  EXPECT_NEAR(views[0].keyframe_from_depth.translation().x(), .12 - .5, 1e-12);
  EXPECT_TRUE(Take(collector).empty()) << "taken already";
}

TEST_F(ViewCollectorTest, ViewsFollowTheirReferenceWhenItIsMoved) {
  ViewCollector collector(1);
  collector.Add(MakeFrame(), Tracked());
  map_.SetKeyframePose(KeyframeId(0), CameraAt(.3, 0, 0));
  EXPECT_NEAR(Take(collector).at(0).keyframe_from_depth.translation().x(), .42 - .5, 1e-12);
}

TEST_F(ViewCollectorTest, ImagesAreCoarserAndKeepStampLabelsAndMask) {
  ViewCollector collector(1);
  collector.Add(MakeFrame(), Tracked());
  const LabelledFrame view = Take(collector).at(0);
  const cv::Size size(kWidth / 2, kHeight / 2);
  for (const cv::Mat* image : {&view.color, &view.depth_m, &view.class_ids, &view.confidence,
                               &view.instances, &view.dynamic_mask}) {
    EXPECT_EQ(image->size(), size);
  }
  EXPECT_EQ(view.stamp_ns, 33);
  EXPECT_EQ(view.depth_m.at<float>(1, 1), 2);
  for (int column = 0; column < size.width; ++column) {
    const bool on_instance = column == 3;
    EXPECT_EQ(view.class_ids.at<std::uint8_t>(1, column), on_instance ? 3 : kNoLabel);
    EXPECT_EQ(view.dynamic_mask.at<std::uint8_t>(1, column), on_instance ? 255 : 0);
  }
}

TEST_F(ViewCollectorTest, TakesEachNthFrameSinceTheLastKeyframe) {
  ViewCollector collector(3);
  for (int i = 0; i < 7; ++i) collector.Add(MakeFrame(), Tracked());
  EXPECT_EQ(Take(collector).size(), 2U);
  for (int i = 0; i < 2; ++i) collector.Add(MakeFrame(), Tracked());
  EXPECT_TRUE(Take(collector).empty());
}

TEST_F(ViewCollectorTest, ViewsOfALongTimeAreThinnedOutEvenly) {
  ViewCollector collector(1);
  const int frames = 1000;
  for (int i = 1; i <= frames; ++i) {
    PreparedFrame prepared = MakeFrame();
    prepared.frame.depth_m.setTo(i);
    collector.Add(prepared, Tracked());
  }
  const std::vector<LabelledFrame> views = Take(collector);
  ASSERT_LE(views.size(), ViewCollector::kMaxViews);
  ASSERT_GE(views.size(), ViewCollector::kMaxViews / 2);
  const float step = 32;  // 1,000 frames in at most 32 views, by doubling
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].depth_m.at<float>(0, 0), step * static_cast<float>(i + 1));
  }
  for (int i = 0; i < 3; ++i) collector.Add(MakeFrame(), Tracked());
  EXPECT_EQ(Take(collector).size(), 3U) << "begins anew with its own stride";
}

TEST_F(ViewCollectorTest, NothingIsKeptWithAStrideOfZero) {
  ViewCollector collector(0);
  for (int i = 0; i < 5; ++i) collector.Add(MakeFrame(), Tracked());
  EXPECT_TRUE(Take(collector).empty());
}

TEST_F(ViewCollectorTest, FramesWithoutAPoseOrInAnotherWorldAreLeftOut) {
  ViewCollector collector(1);
  TrackingResult lost = Tracked();
  lost.status = TrackingStatus::kLost;
  collector.Add(MakeFrame(), lost);
  collector.Add(MakeFrame(), Tracked(1));
  EXPECT_TRUE(Take(collector).empty());
  collector.Add(MakeFrame(), Tracked());
  KeyframeCandidate begins = Candidate();
  begins.begins_submap = true;
  EXPECT_TRUE(collector.Take(begins, *map_.Snapshot()).empty());
}

}  // namespace
}  // namespace ofm
