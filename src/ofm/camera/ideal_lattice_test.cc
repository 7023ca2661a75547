#include "ofm/camera/ideal_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <tuple>

namespace ofm {
namespace {

/// The benchmark's strongest lens, at a quarter of its size so that tests are quick.
PinholeCamera DistortedCamera() {
  PinholeCamera camera = *FindCameraPreset("tum-fr1");
  camera.width = 160;
  camera.height = 120;
  for (double* length : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *length /= 4;
  return camera;
}

PinholeCamera PlainCamera(int width, int height) {
  PinholeCamera camera;
  camera.width = width;
  camera.height = height;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

/// The value at a pixel is 2 · column + row.
cv::Mat MakeRamp(cv::Size size) {
  cv::Mat ramp(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) ramp.at<float>(y, x) = static_cast<float>(2 * x + y);
  }
  return ramp;
}

class IdealLatticeSpacings : public testing::TestWithParam<std::tuple<bool, int>> {
 protected:
  IdealLatticeSpacings()
      : camera_(std::get<0>(GetParam()) ? DistortedCamera() : PlainCamera(163, 118)),
        spacing_px_(std::get<1>(GetParam())),
        lattice_(camera_, spacing_px_) {}

  PinholeCamera camera_;
  int spacing_px_;
  IdealLattice lattice_;
};

TEST_P(IdealLatticeSpacings, PlaceIsTheWayBackFromIdealPx) {
  for (const double column : {-3.0, 0.0, 7.25}) {
    const Eigen::Vector2d place(column, 2.5 * column);
    EXPECT_LT((lattice_.Place(lattice_.IdealPx(place.x(), place.y())) - place).norm(), 1e-12);
  }
  const Eigen::Vector2d step = lattice_.IdealPx(4, 9) - lattice_.IdealPx(3, 7);
  EXPECT_LT((step - spacing_px_ * Eigen::Vector2d(1, 2)).norm(), 1e-9);
}

TEST_P(IdealLatticeSpacings, ItsCameraSeesTheSameRays) {
  const PinholeCamera& small = lattice_.camera();
  EXPECT_FALSE(small.HasDistortion());
  EXPECT_EQ(small.width, lattice_.cols());
  EXPECT_EQ(small.height, lattice_.rows());
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.3, -0.2, 1.5), Eigen::Vector3d(-1, 0.6, 3)}) {
    EXPECT_LT((small.Project(point) - lattice_.Place(camera_.ProjectIdeal(point))).norm(), 1e-9);
  }
}

/// Of all points, by brute force.
TEST_P(IdealLatticeSpacings, EveryPixelKnowsTheNearestPoint) {
  ASSERT_EQ(lattice_.nearest_points().size(), cv::Size(camera_.width, camera_.height));
  for (int y = 0; y < camera_.height; y += 7) {
    for (int x = 0; x < camera_.width; x += 9) {
      const Eigen::Vector2d ideal = camera_.Undistort({x, y});
      double least = 1e9;
      for (int row = 0; row < lattice_.rows(); ++row) {
        for (int column = 0; column < lattice_.cols(); ++column) {
          least = std::min(least, (lattice_.IdealPx(column, row) - ideal).norm());
        }
      }
      const auto told = lattice_.nearest_points().at<cv::Vec2s>(y, x);
      EXPECT_NEAR((lattice_.IdealPx(told[0], told[1]) - ideal).norm(), least, 1e-9);
      EXPECT_LE(least, 0.75 * spacing_px_) << "the lattice covers pixel " << x << ", " << y;
    }
  }
}

/// Every pixel gets what the lattice read not farther than a spacing and a half away.
TEST_P(IdealLatticeSpacings, ImageSampledAndBroughtBackIsTheImage) {
  const cv::Mat ramp = MakeRamp({camera_.width, camera_.height});
  const cv::Mat sampled = lattice_.SampleNearest(ramp);
  ASSERT_EQ(sampled.size(), lattice_.size());
  const cv::Mat back = lattice_.ToImage(sampled);
  ASSERT_EQ(back.size(), ramp.size());
  int empty = 0;
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      const bool is_border = std::min({x, y, ramp.cols - 1 - x, ramp.rows - 1 - y}) < spacing_px_;
      if (is_border) continue;  // its point may be outside of what the camera sees
      EXPECT_NEAR(back.at<float>(y, x), ramp.at<float>(y, x), 3 * spacing_px_ * 0.75 + 3);
      empty += back.at<float>(y, x) == 0;
    }
  }
  EXPECT_EQ(empty, 0);
}

TEST_P(IdealLatticeSpacings, MeanOfARampIsItsValueAtThePoint) {
  cv::Mat ramp;
  MakeRamp({camera_.width, camera_.height}).convertTo(ramp, CV_32FC1, 0.5);
  const cv::Mat mean = lattice_.SampleMean(ramp);
  ASSERT_EQ(mean.size(), lattice_.size());
  int compared = 0;
  for (int row = 0; row < lattice_.rows(); ++row) {
    for (int column = 0; column < lattice_.cols(); ++column) {
      const Eigen::Vector2d px = camera_.Distort(lattice_.IdealPx(column, row));
      const double border = 2 * spacing_px_;
      const bool is_inside = px.x() > border && px.y() > border &&
                             px.x() < camera_.width - border && px.y() < camera_.height - border;
      if (!is_inside) continue;
      ++compared;
      EXPECT_NEAR(mean.at<float>(row, column), px.x() + px.y() / 2, 0.35) << column << " " << row;
    }
  }
  EXPECT_GT(compared, lattice_.cols() * lattice_.rows() / 2);
}

TEST_P(IdealLatticeSpacings, WhatTheCameraDoesNotSeeIsZero) {
  const cv::Mat white(camera_.height, camera_.width, CV_8UC1, cv::Scalar(200));
  const cv::Mat nearest = lattice_.SampleNearest(white);
  for (int row = 0; row < lattice_.rows(); ++row) {
    for (int column = 0; column < lattice_.cols(); ++column) {
      const Eigen::Vector2d px = camera_.Distort(lattice_.IdealPx(column, row));
      const bool is_outside =
          px.x() < -1 || px.y() < -1 || px.x() > camera_.width || px.y() > camera_.height;
      if (camera_.IsInImage(px)) {
        EXPECT_EQ(nearest.at<std::uint8_t>(row, column), 200);
      } else if (is_outside) {
        EXPECT_EQ(nearest.at<std::uint8_t>(row, column), 0);
      }
    }
  }
}

TEST_P(IdealLatticeSpacings, ImageRectHasAllPixelsOfItsPointsAndFewOthers) {
  const cv::Rect all({}, lattice_.size());
  EXPECT_EQ(lattice_.ImageRect(all), cv::Rect(0, 0, camera_.width, camera_.height));
  EXPECT_TRUE(lattice_.ImageRect({}).empty());
  const int half = lattice_.cols() / 2;
  for (const cv::Rect points :
       {cv::Rect(0, 0, 3, 2), cv::Rect(half, 2, 4, 3), cv::Rect(2, lattice_.rows() - 3, half, 3)}) {
    const cv::Rect image = lattice_.ImageRect(points);
    int outside = 0;
    for (int y = 0; y < camera_.height; ++y) {
      for (int x = 0; x < camera_.width; ++x) {
        const auto nearest = lattice_.nearest_points().at<cv::Vec2s>(y, x);
        outside += points.contains({nearest[0], nearest[1]}) && !image.contains({x, y}) ? 1 : 0;
      }
    }
    EXPECT_EQ(outside, 0) << points;
    EXPECT_LE(image.width, (points.width + 3) * spacing_px_ * 1.5 + 3) << points;
    EXPECT_LE(image.height, (points.height + 3) * spacing_px_ * 1.5 + 3) << points;
  }
}

INSTANTIATE_TEST_SUITE_P(LensAndSpacing, IdealLatticeSpacings,
                         testing::Combine(testing::Bool(), testing::Values(1, 2, 4, 7)));

TEST(IdealLattice, WithoutDistortionItIsARegularGridOverTheImage) {
  const IdealLattice lattice(PlainCamera(40, 24), 4);
  EXPECT_EQ(lattice.size(), cv::Size(10, 6));
  EXPECT_LT((lattice.IdealPx(0, 0) - Eigen::Vector2d(1.5, 1.5)).norm(), 1e-6)
      << "the middle of the first four by four pixels";
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 40; ++x) {
      EXPECT_EQ(lattice.nearest_points().at<cv::Vec2s>(y, x), cv::Vec2s(x / 4, y / 4));
    }
  }
}

TEST(IdealLattice, MeanWithoutDistortionIsThatOfTheCellsPixels) {
  cv::Mat image(24, 40, CV_8UC1, cv::Scalar(0));
  image(cv::Rect(8, 12, 4, 2)) = 100;  // half of the cell (2, 3)
  const cv::Mat mean = IdealLattice(PlainCamera(40, 24), 4).SampleMean(image);
  EXPECT_EQ(mean.at<std::uint8_t>(3, 2), 50);
  EXPECT_EQ(cv::countNonZero(mean), 1);
}

TEST(IdealLattice, SpacingOneWithoutDistortionChangesNothing) {
  const cv::Mat ramp = MakeRamp({40, 24});
  const IdealLattice lattice(PlainCamera(40, 24), 1);
  ASSERT_EQ(lattice.size(), ramp.size());
  EXPECT_EQ(cv::norm(lattice.SampleNearest(ramp), ramp, cv::NORM_INF), 0);
  EXPECT_LT(cv::norm(lattice.SampleMean(ramp), ramp, cv::NORM_INF), 1e-4);
  EXPECT_EQ(cv::norm(lattice.ToImage(ramp), ramp, cv::NORM_INF), 0);
}

TEST(IdealLattice, SizeIsRoundedUpToTheMultiple) {
  for (const int multiple : {1, 2, 8}) {
    const IdealLattice lattice(PlainCamera(41, 25), 2, multiple);
    EXPECT_EQ(lattice.cols() % multiple, 0);
    EXPECT_EQ(lattice.rows() % multiple, 0);
    EXPECT_GE(lattice.cols() * 2, 41);
    EXPECT_LT((lattice.cols() - multiple) * 2, 41);
  }
}

TEST(IdealLattice, LensThatBulgesOutwardsIsCoveredWithinAQuarter) {
  PinholeCamera wild = PlainCamera(160, 120);
  wild.fx = wild.fy = 80;
  wild.k1 = -0.4;  // runs away at its corners
  const IdealLattice lattice(wild, 4);
  EXPECT_GE(lattice.cols(), 160 / 4);
  EXPECT_GE(lattice.rows(), 120 / 4);
  EXPECT_LE(lattice.cols(), 1.5 * 160 / 4 + 1);
  EXPECT_LE(lattice.rows(), 1.5 * 120 / 4 + 1);
}

TEST(IdealLattice, RefusesWrongSpacingsAndImagesOfAnotherSize) {
  EXPECT_THROW(IdealLattice(PlainCamera(40, 24), 0), std::logic_error);
  EXPECT_THROW(IdealLattice(PlainCamera(40, 24), 4, 0), std::logic_error);
  const IdealLattice lattice(PlainCamera(40, 24), 4);
  EXPECT_THROW(lattice.ToImage(cv::Mat::zeros(24, 40, CV_8UC1)), std::logic_error);
}

TEST(IdealLattice, TinyImageHasAtLeastOnePoint) {
  const IdealLattice lattice(PlainCamera(16, 16), 64);
  EXPECT_EQ(lattice.size(), cv::Size(1, 1));
  EXPECT_EQ(lattice.ToImage(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9))).at<std::uint8_t>(15, 15), 9);
}

}  // namespace
}  // namespace ofm
