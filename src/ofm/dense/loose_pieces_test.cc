#include "ofm/dense/loose_pieces.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At, test::Box, test::Render, test::SmallCamera, test::Wall;

/// Something small `x` metres to the right that no mask covers.
Box Thing(double x) { return {{x - .06, -.1, 1.52}, {x + .06, .1, 1.53}, test::kRed}; }

std::vector<Eigen::Vector2f> RaysOf(const PinholeCamera& camera) {
  std::vector<Eigen::Vector2f> rays;
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      rays.push_back(
          camera.UnprojectIdeal(Eigen::Vector2d(column, row), 1).head<2>().cast<float>());
    }
  }
  return rays;
}

PieceView ViewOf(const std::vector<Box>& boxes, const RigidTransform& world_from_camera = {}) {
  const LabelledFrame frame = Render(SmallCamera(), boxes, world_from_camera, KeyframeId(0));
  return {frame.depth_m, frame.dynamic_mask, world_from_camera};
}

/// Of each view, how many pixels are loose.
std::vector<int> CountLoose(const std::vector<PieceView>& views,
                            const KeyframeCloudOptions& options = {}) {
  std::vector<int> counts;
  for (const cv::Mat& loose :
       FindLoosePieces(views, SmallCamera(), RaysOf(SmallCamera()), options)) {
    counts.push_back(cv::countNonZero(loose));
  }
  return counts;
}

TEST(SurfacePieces, APieceEndsAtDepthEdgesAndLargeOnesAreLeftOut) {
  const PieceView view = ViewOf({Wall(), Thing(0)});
  const std::vector<SurfacePiece> pieces = FindSurfacePieces(view, {});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(static_cast<int>(pieces[0].pixels.size()), cv::countNonZero(view.depth_m < 2));
  EXPECT_EQ(pieces[0].cut_share, 0);
  KeyframeCloudOptions all;
  all.max_piece_share = 1;
  EXPECT_EQ(FindSurfacePieces(view, all).size(), 2u);
}

TEST(SurfacePieces, TheImagesBorderCutsAPiece) {
  // The right border is at 0.93 m at this depth: half of the thing is in the image.
  const std::vector<SurfacePiece> pieces = FindSurfacePieces(ViewOf({Wall(), Thing(.93)}), {});
  ASSERT_EQ(pieces.size(), 1u);
  // Of an outline of 17 rows twice and some 5 columns twice, once 17 rows.
  EXPECT_NEAR(pieces[0].cut_share, .4, .05);
}

TEST(SurfacePieces, AMaskCutsAPieceWhereItsDepthIsAlikeAlsoAcrossAShadow) {
  PieceView view = ViewOf({Wall(), Thing(0)});
  const cv::Mat thing = view.depth_m < 2;
  view.dynamic.rowRange(0, 60).setTo(255, thing.rowRange(0, 60));
  std::vector<SurfacePiece> pieces = FindSurfacePieces(view, {});
  ASSERT_EQ(pieces.size(), 1u);
  const double cut_share = pieces[0].cut_share;
  EXPECT_GT(cut_share, .2);
  view.depth_m.rowRange(58, 60) = 0;
  pieces = FindSurfacePieces(view, {});
  ASSERT_GE(pieces.size(), 1u);
  EXPECT_NEAR(pieces.back().cut_share, cut_share, 1e-9);
  view.depth_m.setTo(1, view.dynamic);  // somebody farther forward
  pieces = FindSurfacePieces(view, {});
  ASSERT_GE(pieces.size(), 1u);
  EXPECT_EQ(pieces.back().cut_share, 0);
}

TEST(LoosePieces, WhatOtherViewsLookThroughIsLooseAndTheRoomIsNot) {
  std::vector<PieceView> views;
  for (const double x : {0., .25, .5})
    views.push_back(ViewOf({Wall(), Thing(x)}, At(.1 * x, 0, 0)));
  const std::vector<int> loose = CountLoose(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(loose[i], cv::countNonZero(views[i].depth_m < 2)) << i;
  }
  KeyframeCloudOptions none;
  none.max_looseness = 2;
  EXPECT_EQ(CountLoose(views, none), std::vector<int>(3, 0));
}

TEST(LoosePieces, WhatRestsStaysAtTheImagesBorderToo) {
  for (const double x : {0., .93}) {
    std::vector<PieceView> views;
    for (const double camera_x : {0., .02, .04}) {
      views.push_back(ViewOf({Wall(), Thing(x)}, At(camera_x, 0, 0)));
    }
    EXPECT_EQ(CountLoose(views), std::vector<int>(3, 0)) << x;
  }
}

TEST(LoosePieces, WhatOtherViewsMaskIsLoose) {
  std::vector<PieceView> views(3, ViewOf({Wall(), Thing(0)}));
  const cv::Mat thing = views[0].depth_m < 2;
  for (const std::size_t i : {1u, 2u}) views[i].dynamic = thing.clone();
  EXPECT_EQ(CountLoose(views), (std::vector<int>{cv::countNonZero(thing), 0, 0}));
  // A mask before it, on somebody nearer, says nothing of it.
  for (const std::size_t i : {1u, 2u}) {
    views[i].depth_m = views[i].depth_m.clone();
    views[i].depth_m.setTo(1, thing);
  }
  views.push_back(ViewOf({Wall(), Thing(0)}));
  EXPECT_EQ(CountLoose(views)[0], 0);
}

TEST(LoosePieces, OneViewTellsNothingAndUnmeasuredDepthIsNoPiece) {
  EXPECT_EQ(CountLoose({ViewOf({Wall(), Thing(.93)})}), std::vector<int>{0});
  std::vector<PieceView> views(2, ViewOf({Wall()}));
  for (PieceView& view : views) view.depth_m = cv::Mat::zeros(view.depth_m.size(), CV_32FC1);
  EXPECT_EQ(CountLoose(views), std::vector<int>(2, 0));
}

}  // namespace
}  // namespace ofm
