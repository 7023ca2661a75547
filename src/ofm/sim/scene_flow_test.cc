#include "ofm/sim/scene_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "ofm/sim/sim_sequence.h"
#include "ofm/sim/test_scene.h"

namespace ofm {
namespace {

PinholeCamera SmallCamera() { return MakeSimCamera(64, 48); }

TEST(SceneFlow, NothingMovesNowhere) {
  const Renderer renderer(SmallCamera());
  const Scene scene({MakeTestWall()}, {});
  EXPECT_LT(cv::norm(RenderFlow(renderer, scene, {}, {1, {}}), cv::NORM_INF), 1e-4);
}

TEST(SceneFlow, CameraThatStepsRightSeesTheWallGoLeft) {
  const Renderer renderer(SmallCamera());
  const Scene scene({MakeTestWall()}, {});
  const cv::Mat flow = RenderFlow(renderer, scene, {}, {0, Shift(0.1, 0, 0)});
  const float expected = static_cast<float>(-0.1 * SmallCamera().fx / 4);
  EXPECT_NEAR(flow.at<cv::Vec2f>(5, 7)[0], expected, 1e-4);
  EXPECT_NEAR(flow.at<cv::Vec2f>(40, 60)[0], expected, 1e-4);
  EXPECT_NEAR(flow.at<cv::Vec2f>(5, 7)[1], 0, 1e-4);
}

TEST(SceneFlow, WhatMovesHasItsOwnFlowAndTheWallBehindItHasNone) {
  const Renderer renderer(SmallCamera());
  const WaypointMotion motion{{{0, {0, 0, 2}, 0}, {1, {0, 0.2, 2}, 0}}};
  const Scene scene({MakeTestWall(), MakeTestBody("box", motion, Shape::kBox, {0.2, 0.2, 0.1})},
                    {});
  const cv::Mat flow = RenderFlow(renderer, scene, {0, {}}, {1, {}});
  EXPECT_NEAR(flow.at<cv::Vec2f>(24, 32)[1], 0.2 * SmallCamera().fy / 1.9, 1e-3);
  EXPECT_NEAR(flow.at<cv::Vec2f>(24, 2)[1], 0, 1e-4);
}

TEST(SceneFlow, EndsWhereTheLensReallyPutsThePoint) {
  PinholeCamera camera = SmallCamera();
  camera.k1 = 0.2;
  const Renderer renderer(camera);
  const Scene scene({MakeTestWall()}, {});
  const cv::Mat flow = RenderFlow(renderer, scene, {}, {0, Shift(0.3, 0, 0)});
  const Eigen::Vector2d start(10, 8);
  const Eigen::Vector3d point = camera.UnprojectIdeal(camera.Undistort(start), 4);
  const Eigen::Vector2d end = camera.Project(point - Eigen::Vector3d(0.3, 0, 0));
  EXPECT_NEAR(flow.at<cv::Vec2f>(8, 10)[0], end.x() - start.x(), 1e-3);
  EXPECT_NEAR(flow.at<cv::Vec2f>(8, 10)[1], end.y() - start.y(), 1e-3);
}

TEST(SceneFlow, IsNotANumberWhereNothingIsSeenOrWhatIsSeenGoesBehind) {
  const Renderer renderer(SmallCamera());
  const Scene nothing({MakeTestBody("", StaticMotion{Shift(0, 0, -3)}, Shape::kBox, {1, 1, 1})},
                      {});
  EXPECT_TRUE(std::isnan(RenderFlow(renderer, nothing, {}, {}).at<cv::Vec2f>(24, 32)[0]));
  const Scene wall({MakeTestWall()}, {});
  const cv::Mat flow = RenderFlow(renderer, wall, {}, {0, Shift(0, 0, 5)});
  EXPECT_TRUE(std::isnan(flow.at<cv::Vec2f>(24, 32)[0]));
}

TEST(SceneFlow, SurvivesItsCode) {
  cv::Mat flow(2, 2, CV_32FC2, cv::Scalar(1.25, -3.5));
  flow.at<cv::Vec2f>(0, 1) = {NAN, NAN};
  flow.at<cv::Vec2f>(1, 0) = {600, 0};
  const cv::Mat encoded = EncodeFlow(flow);
  EXPECT_EQ(encoded.at<cv::Vec3w>(0, 0), cv::Vec3w(1, 32768 - 224, 32768 + 80));
  const cv::Mat decoded = DecodeFlow(encoded);
  EXPECT_EQ(decoded.at<cv::Vec2f>(1, 1), cv::Vec2f(1.25, -3.5));
  EXPECT_TRUE(std::isnan(decoded.at<cv::Vec2f>(0, 1)[0]));
  EXPECT_TRUE(std::isnan(decoded.at<cv::Vec2f>(1, 0)[0]));
}

}  // namespace
}  // namespace ofm
