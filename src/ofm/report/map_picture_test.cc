#include "ofm/report/map_picture.h"

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

#include "ofm/dense/label_color.h"
#include "ofm/geometry/rigid_transform.h"

namespace ofm {
namespace {

const cv::Vec3b kWhite(255, 255, 255), kBlue(250, 10, 20), kRed(20, 10, 250);

LabelledPoint PointAt(const Eigen::Vector3f& position, cv::Vec3b bgr) {
  LabelledPoint point;
  point.position = position;
  point.color = {bgr[2], bgr[1], bgr[0]};
  return point;
}

LabelledVoxel VoxelAt(const Eigen::Vector3f& center, cv::Vec3b bgr) {
  return {center, 0, {bgr[2], bgr[1], bgr[0]}, kNoLabel};
}

/// At the origin, looking along z: 100 px to 90 degrees, so that the focal length is 50 px.
Viewpoint SmallView() { return {{}, {100, 80}, std::numbers::pi / 2}; }

TEST(MapPicture, PointsAreDrawnWhereTheCameraSeesThem) {
  LabelledCloud cloud;
  cloud.points = {PointAt({.4F, -.2F, 1}, kBlue), PointAt({0, 0, -1}, kRed)};
  const cv::Mat picture = DrawCloud(cloud, SmallView(), MapColor::kAppearance);
  ASSERT_EQ(picture.size(), cv::Size(100, 80));
  EXPECT_EQ(picture.at<cv::Vec3b>(30, 70), kBlue) << "50 + 50 * 0.4, 40 - 50 * 0.2";
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 50), kWhite) << "behind the camera";
  EXPECT_EQ(picture.at<cv::Vec3b>(30, 74), kWhite);
}

TEST(MapPicture, TheNearerPointHidesTheOther) {
  LabelledCloud cloud;
  cloud.points = {PointAt({0, 0, 1}, kBlue), PointAt({0, 0, 2}, kRed)};
  EXPECT_EQ(DrawCloud(cloud, SmallView(), MapColor::kAppearance).at<cv::Vec3b>(40, 50), kBlue);
  std::swap(cloud.points[0], cloud.points[1]);
  EXPECT_EQ(DrawCloud(cloud, SmallView(), MapColor::kAppearance).at<cv::Vec3b>(40, 50), kBlue);
}

TEST(MapPicture, LabelsHaveTheirColourAndTheRestIsPaler) {
  LabelledCloud cloud;
  cloud.points = {PointAt({0, 0, 1}, kBlue), PointAt({.4F, 0, 1}, kBlue)};
  cloud.points[0].class_id = 3;
  const cv::Mat picture = DrawCloud(cloud, SmallView(), MapColor::kLabel);
  const Rgb label = LabelColor(3);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 50), cv::Vec3b(label.b, label.g, label.r));
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 70), cv::Vec3b(235, 115, 120));
}

TEST(MapPicture, VoxelsAreCubes) {
  // Half a metre wide, its front 0.75 m ahead: from 50 - 50 * 0.25 / 0.75 to 50 + as much.
  VoxelSet voxels{.5, {VoxelAt({0, 0, 2}, kRed), VoxelAt({0, 0, 1}, kBlue)}};
  const cv::Mat picture = DrawVoxels(voxels, SmallView(), MapColor::kAppearance);
  const cv::Vec3b front = picture.at<cv::Vec3b>(40, 50);
  EXPECT_NEAR(front[0], .9 * kBlue[0], 1) << "shaded by its side, and before the red one";
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 50 - 16), front);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 50 - 19), kWhite);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 50 + 15), front);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 50 + 19), kWhite);
}

TEST(MapPicture, VoxelsBehindOrAroundTheCameraAreLeftOut) {
  const VoxelSet voxels{.5, {VoxelAt({0, 0, -1}, kRed), VoxelAt({0, 0, 0}, kBlue)}};
  const cv::Mat picture = DrawVoxels(voxels, SmallView(), MapColor::kAppearance);
  EXPECT_EQ(cv::countNonZero(picture.reshape(1) != 255), 0);
}

TEST(MapPicture, OverlookStandsBehindAndAboveAndLooksAtWhatIsAhead) {
  const RigidTransform camera(ExpSo3({0, .5, 0}), Eigen::Vector3d(1, 2, 3));
  const RigidTransform eye = Overlook(camera, 1, 1.5);
  EXPECT_TRUE(eye.translation().isApprox(camera * Eigen::Vector3d(0, -1.5, -1)));
  const Eigen::Vector3d looked_at = eye.Inverse() * (camera * Eigen::Vector3d(0, 0, 2));
  EXPECT_NEAR(looked_at.x(), 0, 1e-12);
  EXPECT_NEAR(looked_at.y(), 0, 1e-12);
  EXPECT_GT(looked_at.z(), 3);
  const Eigen::Vector3d up = eye.rotation() * Eigen::Vector3d(0, -1, 0);
  EXPECT_GT(up.dot(camera.rotation() * Eigen::Vector3d(0, -1, 0)), .8) << "not upside down";
}

}  // namespace
}  // namespace ofm
