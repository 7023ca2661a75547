#include "ofm/perception/optical_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

const cv::Size kSize(320, 240);

/// The image moved by `shift` [px]; what comes in at the border is the mirrored image.
cv::Mat Shifted(const cv::Mat& image, const Eigen::Vector2f& shift) {
  const cv::Mat transform = (cv::Mat_<double>(2, 3) << 1, 0, shift.x(), 0, 1, shift.y());
  cv::Mat moved;
  cv::warpAffine(image, moved, transform, image.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
  return moved;
}

/// Points on a grid, at least `border` from the image's edge.
std::vector<Eigen::Vector2f> Grid(float border) {
  std::vector<Eigen::Vector2f> points;
  for (float y = border; y <= kSize.height - 1 - border; y += 12.3F) {
    for (float x = border; x <= kSize.width - 1 - border; x += 11.7F) points.emplace_back(x, y);
  }
  return points;
}

FlowResult Track(const cv::Mat& from, const cv::Mat& to, const std::vector<Eigen::Vector2f>& points,
                 const OpticalFlowOptions& options = {}) {
  return TrackPoints(BuildFlowPyramid(from, options), BuildFlowPyramid(to, options), points,
                     options);
}

/// How far a tracked point is from where it must be; infinite where it is not tracked.
float ErrorOfPoint(const FlowResult& flow, std::size_t i, const Eigen::Vector2f& shift) {
  if (!flow.IsTracked(i)) return std::numeric_limits<float>::infinity();
  return (flow.current[i] - flow.previous[i] - shift).norm();
}

TEST(OpticalFlow, FollowsAKnownShiftToATenthOfAPixel) {
  const cv::Mat image = test::MakeTexture(kSize, 1);
  for (const Eigen::Vector2f& shift :
       {Eigen::Vector2f(0.4F, -0.7F), Eigen::Vector2f(13.25F, 6.5F)}) {
    const auto points = Grid(40);
    const FlowResult flow = Track(image, Shifted(image, shift), points);
    ASSERT_EQ(flow.size(), points.size());
    EXPECT_EQ(flow.previous, points);
    std::size_t near = 0;
    for (std::size_t i = 0; i < flow.size(); ++i) {
      near += ErrorOfPoint(flow, i, shift) < 0.1F;
      EXPECT_TRUE(!flow.IsTracked(i) || ErrorOfPoint(flow, i, shift) < 0.2F) << i;
    }
    EXPECT_GE(near, points.size() * 99 / 100);
  }
}

TEST(OpticalFlow, PyramidIsNeededForLargeShifts) {
  const cv::Mat image = test::MakeTexture(kSize, 2);
  cv::Mat coarse;
  cv::GaussianBlur(image, coarse, {}, 4);
  const Eigen::Vector2f shift(24, 0);
  const auto errors = [&](int levels) {
    const FlowResult flow = Track(coarse, Shifted(coarse, shift), Grid(60), {.levels = levels});
    std::size_t right = 0;
    for (std::size_t i = 0; i < flow.size(); ++i) {
      right += ErrorOfPoint(flow, i, shift) < 0.5F;
    }
    return flow.size() - right;
  };
  EXPECT_LT(errors(4) * 4, errors(1));
}

TEST(OpticalFlow, PointThatLeavesTheImageIsLost) {
  const cv::Mat image = test::MakeTexture(kSize, 3);
  const FlowResult flow = Track(image, Shifted(image, {-12, 0}), {{5, 100}, {100, 100}});
  EXPECT_FALSE(flow.IsTracked(0));
  EXPECT_TRUE(flow.IsTracked(1));
}

TEST(OpticalFlow, PointWithoutTextureIsLost) {
  const cv::Mat flat(kSize, CV_8UC1, cv::Scalar(90));
  EXPECT_EQ(Track(flat, flat, {{100, 100}}).status[0], FlowStatus::kLost);
}

/// A patch is covered in the second image: its points cannot be found, and what is found instead
/// does not lead back.
TEST(OpticalFlow, BackwardCheckFindsCoveredPoints) {
  const cv::Mat image = test::MakeTexture(kSize, 4);
  cv::Mat covered = image.clone();
  const cv::Rect cover(100, 60, 100, 100);
  test::MakeTexture(cover.size(), 5).copyTo(covered(cover));
  const auto points = Grid(20);
  const auto count_inside = [&](const FlowResult& flow) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < flow.size(); ++i) {
      const cv::Rect core(cover.x + 15, cover.y + 15, cover.width - 30, cover.height - 30);
      count += flow.IsTracked(i) && core.contains(cv::Point2f(points[i].x(), points[i].y()));
    }
    return count;
  };
  const FlowResult checked = Track(image, covered, points, {.forward_backward_px = 1});
  const FlowResult unchecked = Track(image, covered, points);
  EXPECT_GE(count_inside(unchecked), 30U);
  EXPECT_LE(count_inside(checked) * 5, count_inside(unchecked));
  EXPECT_GT(std::count(checked.status.begin(), checked.status.end(), FlowStatus::kInconsistent), 0);
}

TEST(OpticalFlow, NoPointsGiveAnEmptyResult) {
  const cv::Mat image = test::MakeTexture(kSize, 6);
  EXPECT_EQ(Track(image, image, {}).size(), 0U);
}

TEST(OpticalFlow, StatefulFlowEqualsThatOfPairs) {
  const cv::Mat a = test::MakeTexture(kSize, 7), b = Shifted(a, {3, 1}), c = Shifted(a, {5, -2});
  const auto points = Grid(30);
  OpticalFlow flow({});
  EXPECT_EQ(flow.Advance(a, points).size(), 0U);
  EXPECT_EQ(flow.Advance(b, points).current, Track(a, b, points).current);
  EXPECT_EQ(flow.Advance(c, points).current, Track(b, c, points).current);
}

TEST(OpticalFlow, ImageMayBeOverwrittenAfterTheCall) {
  const cv::Mat a = test::MakeTexture(kSize, 8), b = Shifted(a, {3, 1});
  const auto points = Grid(30);
  OpticalFlow flow({});
  cv::Mat buffer = a.clone();
  flow.Advance(buffer, points);
  b.copyTo(buffer);
  EXPECT_EQ(flow.Advance(buffer, points).current, Track(a, b, points).current);
}

TEST(OpticalFlow, StartsAfreshAfterResetAndWithAnotherSize) {
  const cv::Mat image = test::MakeTexture(kSize, 9);
  const auto points = Grid(30);
  OpticalFlow flow({});
  flow.Advance(image, points);
  flow.Reset();
  EXPECT_EQ(flow.Advance(image, points).size(), 0U);
  EXPECT_EQ(flow.Advance(test::MakeTexture({160, 120}, 9), points).size(), 0U);
}

TEST(OpticalFlow, TinyImageHasFewerLevels) {
  const cv::Mat image = test::MakeTexture({24, 24}, 10);
  const FlowResult flow = Track(image, image, {{12, 12}}, {.window_px = 9, .levels = 6});
  ASSERT_TRUE(flow.IsTracked(0));
  EXPECT_LT((flow.current[0] - flow.previous[0]).norm(), 0.05F);
}

TEST(OpticalFlow, ColourImageIsAProgrammersError) {
  EXPECT_THROW(BuildFlowPyramid(cv::Mat::zeros(kSize, CV_8UC3), {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
