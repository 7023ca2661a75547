#include "ofm/pipeline/front_end.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ofm/features/exclusion.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

using test::Recording;

class FrontEndTest : public testing::Test {
 protected:
  FrontEnd MakeFrontEnd(DynamicsMode mode) const {
    SlamOptions options = test::QuickOptions();
    options.dynamics.mode = mode;
    return {recording_.sequence.camera(), options,
            std::make_unique<test::TruthSegmenter>(recording_.sequence)};
  }

  /// Number of features of `prepared` on the true pixels of people.
  int CountOnPeople(const PreparedFrame& prepared) const {
    const cv::Mat people = recording_.sequence.MoverMask(prepared.frame.id);
    int count = 0;
    for (const Keypoint& keypoint : prepared.features->keypoints) {
      const cv::Point pixel(std::lround(keypoint.pixel.x()), std::lround(keypoint.pixel.y()));
      if (people.at<std::uint8_t>(pixel) != 0) ++count;
    }
    return count;
  }

  Recording recording_{3, 1, 3};
  StageTimes times_;
};

TEST_F(FrontEndTest, GivesNoFeatureOnPeopleWhereTheyAreCulled) {
  FrontEnd front_end = MakeFrontEnd(DynamicsMode::kPaper);
  for (const RgbdFrame& frame : recording_.images) {
    const PreparedFrame prepared = front_end.Process(frame, times_);
    EXPECT_EQ(CountOnPeople(prepared), 0);
    EXPECT_GT(prepared.features->size(), 50U);
    const cv::Mat people = recording_.sequence.MoverMask(frame.id) != 0;
    EXPECT_EQ(cv::countNonZero(people & (prepared.dynamic.mask == 0)), 0) << "all are masked";
    EXPECT_GE(prepared.dynamic.masked_share,
              cv::countNonZero(people) / static_cast<double>(people.total()));
    EXPECT_EQ(prepared.segmentation.frame_id, frame.id);
  }
}

TEST_F(FrontEndTest, GivesFeaturesEverywhereWhereNothingIsCulled) {
  FrontEnd front_end = MakeFrontEnd(DynamicsMode::kOff);
  const PreparedFrame prepared = front_end.Process(recording_.images[0], times_);
  EXPECT_GT(CountOnPeople(prepared), 50);
  EXPECT_EQ(prepared.dynamic.masked_share, 0);
  EXPECT_EQ(times_.stages().count("optical_flow"), 0U);
  EXPECT_EQ(times_.stages().count("features"), 1U);
}

TEST_F(FrontEndTest, FeaturesHaveTheDepthOfTheirPixel) {
  FrontEnd front_end = MakeFrontEnd(DynamicsMode::kPaper);
  const PreparedFrame prepared = front_end.Process(recording_.images[1], times_);
  int with_depth = 0;
  for (std::size_t i = 0; i < prepared.features->size(); ++i) {
    const Eigen::Vector2f& pixel = prepared.features->keypoints[i].pixel;
    const float depth_m = prepared.features->depth_m[i];
    if (depth_m == 0) continue;
    ++with_depth;
    EXPECT_EQ(depth_m, recording_.images[1].depth_m.at<float>(std::lround(pixel.y()),
                                                              std::lround(pixel.x())));
  }
  EXPECT_GT(with_depth, 100);
}

TEST_F(FrontEndTest, TheFrameItselfIsPassedOnUntouched) {
  FrontEnd front_end = MakeFrontEnd(DynamicsMode::kPaper);
  const cv::Mat before = recording_.images[0].color.clone();
  const PreparedFrame prepared = front_end.Process(recording_.images[0], times_);
  EXPECT_EQ(prepared.frame.color.data, recording_.images[0].color.data) << "shared, not copied";
  EXPECT_EQ(cv::norm(before, prepared.frame.color, cv::NORM_INF), 0);
  EXPECT_EQ(prepared.frame.stamp_ns, recording_.images[0].stamp_ns);
}

TEST_F(FrontEndTest, SameFramesGiveTheSameFeatures) {
  FrontEnd a = MakeFrontEnd(DynamicsMode::kPaper), b = MakeFrontEnd(DynamicsMode::kPaper);
  for (const RgbdFrame& frame : recording_.images) {
    const PreparedFrame first = a.Process(frame, times_), second = b.Process(frame, times_);
    EXPECT_EQ(first.features->descriptors, second.features->descriptors);
    EXPECT_EQ(cv::norm(first.dynamic.mask, second.dynamic.mask, cv::NORM_INF), 0);
  }
}

TEST_F(FrontEndTest, FlowMayBeAheadOfTheRest) {
  FrontEnd a = MakeFrontEnd(DynamicsMode::kFull), b = MakeFrontEnd(DynamicsMode::kFull);
  std::vector<FlowedFrame> flowed;
  for (const RgbdFrame& frame : recording_.images) flowed.push_back(a.Flow(frame, times_));
  for (std::size_t i = 0; i < flowed.size(); ++i) {
    const PreparedFrame first = a.Perceive(flowed[i], times_);
    const PreparedFrame second = b.Process(recording_.images[i], times_);
    EXPECT_EQ(first.features->descriptors, second.features->descriptors);
    EXPECT_EQ(cv::norm(first.dynamic.mask, second.dynamic.mask, cv::NORM_INF), 0);
  }
}

TEST_F(FrontEndTest, KnowsTheSegmentersClasses) {
  EXPECT_THAT(MakeFrontEnd(DynamicsMode::kPaper).class_names(), testing::ElementsAre("person"));
}

TEST_F(FrontEndTest, FullCullingTellsTheCamerasMotionAndHowStaticFeaturesAre) {
  FrontEnd front_end = MakeFrontEnd(DynamicsMode::kFull);
  for (const RgbdFrame& frame : recording_.images) {
    const PreparedFrame prepared = front_end.Process(frame, times_);
    EXPECT_LT(CountOnPeople(prepared), static_cast<int>(prepared.features->size()) / 30);
    EXPECT_GT(prepared.features->size(), 50U);
    EXPECT_EQ(prepared.features->static_probability.size(), prepared.features->size());
    EXPECT_EQ(prepared.dynamic.camera_motion.has_value(), frame.id != FrameId(0));
  }
  EXPECT_EQ(times_.stages().count("optical_flow"), 0U) << "that is the paper's";
}

TEST_F(FrontEndTest, FeaturesHaveTheStaticProbabilityOfTheirPixel) {
  FrontEnd front_end = MakeFrontEnd(DynamicsMode::kFull);
  front_end.Process(recording_.images[0], times_);
  const PreparedFrame prepared = front_end.Process(recording_.images[1], times_);
  for (std::size_t i = 0; i < prepared.features->size(); ++i) {
    const Eigen::Vector2f& pixel = prepared.features->keypoints[i].pixel;
    const cv::Point place(std::lround(pixel.x()), std::lround(pixel.y()));
    EXPECT_EQ(prepared.features->StaticProbability(static_cast<int>(i)),
              prepared.dynamic.static_probability.at<std::uint8_t>(place) / 255.0F);
  }
}

TEST_F(FrontEndTest, FullTakesAsManyFeaturesOfWhatIsVisibleAsWithoutPeopleAndThePaperDoesNot) {
  double masked_share = 0;
  const auto count = [&](DynamicsMode mode, double crowded_features) {
    SlamOptions options = test::QuickOptions();
    options.features.count = 150;
    options.dynamics.mode = mode;
    options.dynamics.crowded_features = crowded_features;
    FrontEnd front_end(recording_.sequence.camera(), options,
                       std::make_unique<test::TruthSegmenter>(recording_.sequence));
    const PreparedFrame prepared = front_end.Process(recording_.images[0], times_);
    masked_share = prepared.dynamic.masked_share;
    return static_cast<double>(prepared.features->size());
  };
  const double fewest = count(DynamicsMode::kFull, 1);
  ASSERT_GT(masked_share, 0.1);
  ASSERT_LT(masked_share, 0.75);
  const double times = 1 / (1 - masked_share);
  EXPECT_NEAR(count(DynamicsMode::kFull, 5) / fewest, times, 0.02);
  const double less = 1 + (times - 1) / 2;
  EXPECT_NEAR(count(DynamicsMode::kFull, less) / fewest, less, 0.02) << "no more than asked for";
  EXPECT_EQ(count(DynamicsMode::kPaper, 1), count(DynamicsMode::kPaper, 5));
}

TEST_F(FrontEndTest, ThePaperTakesFeaturesFromTheWholeImageAndDropsThoseOnPeople) {
  FrontEnd paper = MakeFrontEnd(DynamicsMode::kPaper), off = MakeFrontEnd(DynamicsMode::kOff);
  const PreparedFrame culled = paper.Process(recording_.images[0], times_);
  const PreparedFrame all = off.Process(recording_.images[0], times_);
  std::vector<Descriptor> outside;
  for (std::size_t i = 0; i < all.features->size(); ++i) {
    if (!IsExcluded(culled.dynamic.mask, all.features->keypoints[i].pixel)) {
      outside.push_back(all.features->descriptors[i]);
    }
  }
  EXPECT_LT(outside.size(), all.features->size());
  EXPECT_EQ(culled.features->descriptors, outside);
}

}  // namespace
}  // namespace ofm
