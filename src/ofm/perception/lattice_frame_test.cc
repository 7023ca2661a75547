#include "ofm/perception/lattice_frame.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "ofm/base/error.h"
#include "ofm/sim/sim_sequence.h"

namespace ofm {
namespace {

/// A chequered left half, a plain right half, 2 m away.
RgbdFrame MakeRgbdFrame(cv::Size size) {
  RgbdFrame frame;
  frame.stamp_ns = 5;
  frame.depth_stamp_ns = 7;
  frame.gray = cv::Mat(size, CV_8UC1, cv::Scalar(90));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width / 2; ++x) {
      frame.gray.at<std::uint8_t>(y, x) = (x / 8 + y / 8) % 2 == 0 ? 40 : 200;
    }
  }
  frame.depth_m = cv::Mat(size, CV_32FC1, cv::Scalar(2));
  return frame;
}

TEST(MotionLattice, FrameHasOneCellPerFewPixelsAndFourGreyValuesPerCell) {
  const MotionLattice lattice(MakeSimCamera(160, 120), {.cell_px = 4});
  const LatticeFrame frame = lattice.MakeFrame(MakeRgbdFrame({160, 120}));
  EXPECT_EQ(lattice.size(), cv::Size(40, 30));
  EXPECT_EQ(frame.depth_m.size(), lattice.size());
  EXPECT_EQ(frame.texture.size(), lattice.size());
  EXPECT_EQ(frame.gray.size(), cv::Size(80, 60));
  EXPECT_EQ(frame.stamp_ns, 5);
  EXPECT_EQ(frame.depth_stamp_ns, 7);
}

TEST(MotionLattice, GreyIsTwiceAsFineAsTheCellsWhateverTheSize) {
  for (const cv::Size size : {cv::Size(161, 119), cv::Size(158, 121), cv::Size(16, 16)}) {
    for (const int cell_px : {2, 4, 6, 10}) {
      const MotionLattice lattice(MakeSimCamera(size.width, size.height), {.cell_px = cell_px});
      const LatticeFrame frame = lattice.MakeFrame(MakeRgbdFrame(size));
      EXPECT_EQ(frame.gray.size(), lattice.size() * 2) << size << " " << cell_px;
      EXPECT_EQ(frame.texture.size(), lattice.size());
    }
  }
}

TEST(MotionLattice, OddCellsAreRefused) {
  EXPECT_THROW(MotionLattice(MakeSimCamera(160, 120), {.cell_px = 3}), Error);
}

TEST(MotionLattice, DepthOutOfRangeIsNone) {
  const MotionLattice lattice(MakeSimCamera(160, 120),
                              {.cell_px = 4, .min_depth_m = 0.5, .max_depth_m = 4});
  RgbdFrame image = MakeRgbdFrame({160, 120});
  const float bad[] = {0,
                       -1,
                       0.4F,
                       4.1F,
                       std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity()};
  for (int i = 0; i < 6; ++i) image.depth_m(cv::Rect(16 * i, 0, 16, 16)) = bad[i];
  const LatticeFrame frame = lattice.MakeFrame(image);
  EXPECT_TRUE(cv::checkRange(frame.depth_m));
  EXPECT_EQ(cv::countNonZero(frame.depth_m(cv::Rect(0, 0, 24, 4))), 0);
  EXPECT_EQ(cv::countNonZero(frame.depth_m), 40 * 30 - 24 * 4);
  EXPECT_EQ(frame.depth_m.at<float>(10, 10), 2);
}

TEST(MotionLattice, TextureIsWhereGreyValuesChange) {
  const MotionLattice lattice(MakeSimCamera(160, 120), {.cell_px = 4});
  const LatticeFrame frame = lattice.MakeFrame(MakeRgbdFrame({160, 120}));
  EXPECT_EQ(cv::countNonZero(frame.texture(cv::Rect(1, 1, 17, 28))), 17 * 28);
  EXPECT_EQ(cv::countNonZero(frame.texture(cv::Rect(24, 0, 16, 30))), 0);
}

TEST(MotionLattice, TextureThresholdIsThatOfTheOptions) {
  const MotionLattice lattice(MakeSimCamera(160, 120), {.cell_px = 4, .min_texture = 2000});
  EXPECT_EQ(cv::countNonZero(lattice.MakeFrame(MakeRgbdFrame({160, 120})).texture), 0);
}

TEST(MotionLattice, FrameKeepsItsImagesWhenTheSourceIsWrittenOver) {
  const MotionLattice lattice(MakeSimCamera(160, 120), {.cell_px = 2});
  RgbdFrame image = MakeRgbdFrame({160, 120});
  const LatticeFrame frame = lattice.MakeFrame(image);
  const cv::Mat gray = frame.gray.clone(), depth = frame.depth_m.clone();
  image.gray.setTo(0);
  image.depth_m.setTo(0);
  EXPECT_EQ(cv::norm(frame.gray, gray, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(frame.depth_m, depth, cv::NORM_INF), 0);
}

TEST(MotionLattice, LensIsUndistorted) {
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  const MotionLattice lattice(camera, {.cell_px = 4});
  RgbdFrame image = MakeRgbdFrame({640, 480});
  const Eigen::Vector2d ideal(60, 420), pixel = camera.Distort(ideal);
  ASSERT_GT((ideal - pixel).norm(), 4);
  cv::circle(image.depth_m, {static_cast<int>(pixel.x()), static_cast<int>(pixel.y())}, 6, 3.0,
             cv::FILLED);
  const Eigen::Vector2d place = lattice.cells().Place(ideal);
  const cv::Point cell(static_cast<int>(std::lround(place.x())),
                       static_cast<int>(std::lround(place.y())));
  EXPECT_EQ(lattice.MakeFrame(image).depth_m.at<float>(cell), 3);
}

}  // namespace
}  // namespace ofm
