#include "ofm/perception/lattice_flow.h"

#include <gtest/gtest.h>

#include "ofm/perception/carry_test_support.h"

namespace ofm {
namespace {

/// An object that moves by (8, -4) px a frame before a wall that stands still.
class LatticeFlowTest : public testing::Test {
 protected:
  RgbdFrame Frame(std::uint32_t id) const {
    const auto step = static_cast<float>(id);
    return scene_.Frame(id, {150 + 8 * step, 130 - 4 * step});
  }

  const test::CarryScene scene_;
  LatticeFlow flow_{scene_.camera(), {.cell_px = 4}};
};

TEST_F(LatticeFlowTest, FirstFrameHasNone) {
  const LatticeStep step = flow_.Process(Frame(0));
  EXPECT_TRUE(step.flow.empty());
  EXPECT_EQ(step.frame.depth_m.size(), flow_.lattice().size());
  EXPECT_EQ(step.frame.stamp_ns, Frame(0).stamp_ns);
}

TEST_F(LatticeFlowTest, TellsInCellsWhereThingsWere) {
  flow_.Process(Frame(0));
  const cv::Mat flow = flow_.Process(Frame(1)).flow;
  ASSERT_EQ(flow.size(), flow_.lattice().size());
  const auto object = flow.at<cv::Vec2f>(126 / 4, 158 / 4), wall = flow.at<cv::Vec2f>(10, 10);
  EXPECT_NEAR(object[0], -2, 0.1);
  EXPECT_NEAR(object[1], 1, 0.1);
  EXPECT_NEAR(cv::norm(wall), 0, 0.1);
}

TEST_F(LatticeFlowTest, TimeThatDoesNotIncreaseBeginsAnew) {
  flow_.Process(Frame(3));
  EXPECT_TRUE(flow_.Process(Frame(3)).flow.empty());
  EXPECT_TRUE(flow_.Process(Frame(2)).flow.empty());
  EXPECT_FALSE(flow_.Process(Frame(3)).flow.empty());
}

TEST_F(LatticeFlowTest, FlowDependsOnTheTwoFramesAlone) {
  LatticeFlow other(scene_.camera(), {.cell_px = 4});
  const LatticeStep first = flow_.Process(Frame(0)), second = flow_.Process(Frame(1));
  other.Process(Frame(5));
  EXPECT_EQ(cv::norm(other.FlowToLast(second.frame, first.frame), second.flow, cv::NORM_INF), 0);
}

TEST_F(LatticeFlowTest, StepsAreNotWrittenAgain) {
  flow_.Process(Frame(0));
  const LatticeStep step = flow_.Process(Frame(1));
  const cv::Mat flow = step.flow.clone(), depth_m = step.frame.depth_m.clone();
  flow_.Process(Frame(2));
  EXPECT_EQ(cv::norm(step.flow, flow, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(step.frame.depth_m, depth_m, cv::NORM_INF), 0);
}

TEST(LatticeFlow, TinyImagesDoNotFlow) {
  const test::CarryScene tiny{.size = {32, 24}, .radii = {5, 5}};
  LatticeFlow flow(tiny.camera(), {});
  flow.Process(tiny.Frame(0, {16, 12}));
  EXPECT_EQ(cv::norm(flow.Process(tiny.Frame(1, {20, 12})).flow), 0);
}

}  // namespace
}  // namespace ofm
