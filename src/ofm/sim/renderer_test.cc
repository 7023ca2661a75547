#include "ofm/sim/renderer.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "ofm/sim/camera_path.h"
#include "ofm/sim/room.h"
#include "ofm/sim/sim_sequence.h"
#include "ofm/sim/test_scene.h"

namespace ofm {
namespace {

PinholeCamera DistortedCamera() {
  PinholeCamera camera = MakeSimCamera(160, 120);
  camera.k1 = 0.2624, camera.k2 = -0.9531, camera.p1 = -0.0054, camera.p2 = 0.0026;
  camera.k3 = 1.1633;
  return camera;
}

/// True where the depth around a pixel is that of one smooth surface.
bool IsSmooth(const cv::Mat& depth_m, int x, int y) {
  if (x < 2 || y < 2 || x + 2 >= depth_m.cols || y + 2 >= depth_m.rows) return false;
  double low, high;
  cv::minMaxLoc(depth_m(cv::Rect(x - 2, y - 2, 5, 5)), &low, &high);
  return low > 0 && high - low < 0.05 * low;
}

/// Depth at a pixel of any coordinates; exact on planes, where 1 / z is linear.
double InterpolateDepth(const cv::Mat& depth_m, const Eigen::Vector2d& px) {
  const int x = static_cast<int>(px.x()), y = static_cast<int>(px.y());
  const double ax = px.x() - x, ay = px.y() - y;
  const auto inverse = [&](int dx, int dy) { return 1.0 / depth_m.at<float>(y + dy, x + dx); };
  return 1 / ((1 - ay) * ((1 - ax) * inverse(0, 0) + ax * inverse(1, 0)) +
              ay * ((1 - ax) * inverse(0, 1) + ax * inverse(1, 1)));
}

struct Agreement {
  int compared = 0;
  double depth_m = 0, color = 0, shifted_color = 0;  ///< mean absolute differences
};

/// Warps the smooth surfaces of `a` into `b` by depth and pose and compares what both saw.
Agreement CompareViews(const RenderedImage& a, const RenderedImage& b, const PinholeCamera& camera,
                       const RigidTransform& b_from_a) {
  Agreement result;
  cv::Mat color_a, color_b;
  cv::cvtColor(a.color, color_a, cv::COLOR_BGR2GRAY);
  cv::cvtColor(b.color, color_b, cv::COLOR_BGR2GRAY);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      if (!IsSmooth(a.depth_m, x, y)) continue;
      const Eigen::Vector2d ideal = camera.Undistort(Eigen::Vector2d(x, y));
      const Eigen::Vector3d in_b =
          b_from_a * camera.UnprojectIdeal(ideal, a.depth_m.at<float>(y, x));
      const Eigen::Vector2d px = camera.Project(in_b);
      if (!IsSmooth(b.depth_m, static_cast<int>(px.x()), static_cast<int>(px.y()))) continue;
      const double depth_difference = std::abs(InterpolateDepth(b.depth_m, px) - in_b.z());
      if (depth_difference > 0.05) continue;  // hidden in b
      cv::Mat patch;
      cv::getRectSubPix(color_b, {1, 1}, cv::Point2f(float(px.x()), float(px.y())), patch);
      const double here = color_a.at<uchar>(y, x);
      result.compared += 1;
      result.depth_m += depth_difference;
      result.color += std::abs(patch.at<uchar>(0, 0) - here);
      cv::getRectSubPix(color_b, {1, 1}, cv::Point2f(float(px.x()) + 3, float(px.y())), patch);
      result.shifted_color += std::abs(patch.at<uchar>(0, 0) - here);
    }
  }
  result.depth_m /= result.compared;
  result.color /= result.compared;
  result.shifted_color /= result.compared;
  return result;
}

TEST(Renderer, WallFillsTheImageAtItsDepth) {
  const Renderer renderer(MakeSimCamera(160, 120));
  const RenderedImage image = renderer.Render(Scene({MakeTestWall()}, {}), 0, {});
  ASSERT_EQ(image.color.size(), cv::Size(160, 120));
  ASSERT_EQ(image.color.type(), CV_8UC3);
  ASSERT_EQ(image.depth_m.type(), CV_32FC1);
  double low, high;
  cv::minMaxLoc(image.depth_m, &low, &high);
  EXPECT_NEAR(low, 4, 1e-5);
  EXPECT_NEAR(high, 4, 1e-5);
  EXPECT_EQ(cv::countNonZero(image.instance), 0);
}

TEST(Renderer, WhereNothingIsThereIsNoDepth) {
  const Renderer renderer(MakeSimCamera(160, 120));
  const RenderedImage image = renderer.Render(Scene({}, {}), 0, {});
  EXPECT_EQ(cv::countNonZero(image.depth_m), 0);
  EXPECT_EQ(cv::countNonZero(image.instance), 0);
  EXPECT_EQ(image.color.at<cv::Vec3b>(60, 80), cv::Vec3b(60, 60, 60));
}

TEST(Renderer, MaskIsExactlyWhatTheRaysMeet) {
  const PinholeCamera camera = DistortedCamera();
  const Eigen::Vector3d centre(0.2, -0.1, 2);
  const double radius = 0.5;
  const Body ball =
      MakeTestBody("sports ball", StaticMotion{{Eigen::Quaterniond::Identity(), centre}},
                   Shape::kEllipsoid, Eigen::Vector3d::Constant(radius));
  const RenderedImage image =
      Renderer(camera).Render(Scene({MakeTestWall(), ball}, {}), 0, RigidTransform());
  int inside = 0, wrong = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray =
          camera.UnprojectIdeal(camera.Undistort(Eigen::Vector2d(x, y)), 1).normalized();
      const double miss_m = ray.cross(centre).norm();  // distance of the ray from the centre
      if (std::abs(miss_m - radius) < 1e-4) continue;
      inside += miss_m < radius;
      wrong += (miss_m < radius) != (image.instance.at<uchar>(y, x) == 1);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside, 1500);
}

TEST(Renderer, LensDistortionMovesPixelsAsTheCameraSays) {
  PinholeCamera camera = DistortedCamera();
  camera.k1 = -0.2;
  const Eigen::Vector3d centre(-0.9, 0.7, 2.4);
  const Body dot = MakeTestBody("b", StaticMotion{{Eigen::Quaterniond::Identity(), centre}},
                                Shape::kEllipsoid, Eigen::Vector3d::Constant(0.08));
  const auto find = [&](const PinholeCamera& any) {
    const cv::Mat mask = Renderer(any).RenderInstances(Scene({dot}, {}), 0, {});
    const cv::Moments m = cv::moments(mask, true);
    return Eigen::Vector2d(m.m10 / m.m00, m.m01 / m.m00);
  };
  const Eigen::Vector2d ideal = find(MakeSimCamera(160, 120));
  const Eigen::Vector2d distorted = find(camera);
  EXPECT_LT((ideal - camera.ProjectIdeal(centre)).norm(), 0.4);
  EXPECT_LT((distorted - camera.Project(centre)).norm(), 0.4);
  EXPECT_GT((distorted - ideal).norm(), 2);
}

TEST(Renderer, TwoViewsOfARoomAgreeInColorAndDepth) {
  const PinholeCamera camera = MakeSimCamera(320, 240);
  const Scene room = MakeRoom({}, 3);
  const RigidTransform a = LookAt({0, -0.8, 1.35}, {0, 2, 0.95});
  const RigidTransform b = LookAt({0.15, -0.7, 1.45}, {0.1, 2, 1.0});
  const Renderer renderer(camera);
  const Agreement agreement = CompareViews(renderer.Render(room, 0, a), renderer.Render(room, 0, b),
                                           camera, b.Inverse() * a);
  EXPECT_GT(agreement.compared, 30000);
  EXPECT_LT(agreement.depth_m, 1e-3);
  EXPECT_LT(agreement.color, 10);
  EXPECT_GT(agreement.shifted_color, 2 * agreement.color);
}

TEST(Renderer, TwoViewsAgreeUnderDistortionToo) {
  const PinholeCamera camera = DistortedCamera();
  const Scene room = MakeRoom({}, 4);
  const RigidTransform a = LookAt({0, -0.8, 1.35}, {0, 2, 0.95});
  const RigidTransform b = LookAt({-0.1, -0.75, 1.3}, {0.05, 2, 0.9});
  const Renderer renderer(camera);
  const Agreement agreement = CompareViews(renderer.Render(room, 0, a), renderer.Render(room, 0, b),
                                           camera, b.Inverse() * a);
  EXPECT_GT(agreement.compared, 5000);
  EXPECT_LT(agreement.depth_m, 2e-3);
  EXPECT_GT(agreement.shifted_color, 1.8 * agreement.color);
}

TEST(Renderer, OnlyMoversChangeWithTime) {
  RoomOptions options;
  options.people = 1;
  const Scene room = MakeRoom(options, 5);
  const RigidTransform eye =
      LookAt(room.viewpoint().eye_in_world, room.viewpoint().target_in_world);
  const Renderer renderer(MakeSimCamera(160, 120));
  const RenderedImage before = renderer.Render(room, 0, eye);
  const RenderedImage after = renderer.Render(room, 0.4, eye);
  const cv::Mat person = (before.instance == 1) | (after.instance == 1);
  cv::Mat around, changed;
  cv::dilate(person, around, cv::Mat::ones(3, 3, CV_8U));  // mixed pixels
  cv::absdiff(before.depth_m, after.depth_m, changed);
  EXPECT_EQ(cv::countNonZero((changed > 0) & ~person), 0);
  EXPECT_GT(cv::countNonZero((changed > 0.1) & person), 300);
  cv::Mat difference, gray;
  cv::absdiff(before.color, after.color, difference);
  cv::cvtColor(difference, gray, cv::COLOR_BGR2GRAY);
  EXPECT_EQ(cv::countNonZero(gray & ~around), 0);
  EXPECT_GT(cv::countNonZero(gray & person), 300);
}

TEST(Renderer, EdgesOfObjectsAreSmoothed) {
  // A white box before a black background: pixels on its border are in between.
  Body box = MakeTestBody("box", StaticMotion{{ExpSo3({0, 0, 0.2}), Eigen::Vector3d(0, 0, 2)}},
                          Shape::kRectangle, {0.5, 0.5, 0});
  TextureOptions plain;
  plain.contrast = 0;
  box.parts[0].texture = std::make_shared<Texture>(plain, 1);
  const cv::Mat color = Renderer(MakeSimCamera(160, 120)).Render(Scene({box}, {}), 0, {}).color;
  const int inside = color.at<cv::Vec3b>(60, 80)[0];
  const int outside = color.at<cv::Vec3b>(2, 2)[0];
  ASSERT_GT(std::abs(inside - outside), 8);
  cv::Mat gray, mixed;
  cv::cvtColor(color, gray, cv::COLOR_BGR2GRAY);
  mixed = (gray != inside) & (gray != outside);
  EXPECT_GT(cv::countNonZero(mixed), 60);
  EXPECT_LT(cv::countNonZero(mixed), 600);
}

TEST(Renderer, InstancesAloneAreThoseOfTheWholeImage) {
  RoomOptions options;
  options.people = 2;
  const Scene room = MakeRoom(options, 6);
  const RigidTransform eye =
      LookAt(room.viewpoint().eye_in_world, room.viewpoint().target_in_world);
  const Renderer renderer(MakeSimCamera(160, 120));
  const cv::Mat alone = renderer.RenderInstances(room, 1.5, eye);
  EXPECT_EQ(cv::norm(alone, renderer.Render(room, 1.5, eye).instance, cv::NORM_INF), 0);
  EXPECT_GT(cv::countNonZero(alone), 1000);
}

}  // namespace
}  // namespace ofm
