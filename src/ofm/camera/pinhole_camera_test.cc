#include "ofm/camera/pinhole_camera.h"

#include <gtest/gtest.h>

#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace ofm {
namespace {

const char* const kPresets[] = {"tum-fr1", "tum-fr2", "tum-fr3"};

PinholeCamera Preset(const char* name) { return FindCameraPreset(name).value(); }

// Calls `f` on a grid over the image that includes its borders.
template <class F>
void ForGridOf(const PinholeCamera& camera, F f) {
  for (int row = 0; row <= 48; ++row) {
    for (int column = 0; column <= 64; ++column) {
      f(Eigen::Vector2d(column * (camera.width - 1) / 64.0, row * (camera.height - 1) / 48.0));
    }
  }
}

TEST(FindCameraPreset, HasTheBenchmarksPublishedIntrinsics) {
  struct Published {
    const char* name;
    double fx, fy, cx, cy, k1, k2, p1, p2, k3;
  };
  for (const Published& want :
       {Published{"tum-fr1", 517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633},
        Published{"tum-fr2", 520.9, 521.0, 325.1, 249.7, 0.2312, -0.7849, -0.0033, -0.0001, 0.9172},
        Published{"tum-fr3", 535.4, 539.2, 320.1, 247.6, 0, 0, 0, 0, 0}}) {
    const PinholeCamera camera = Preset(want.name);
    EXPECT_EQ(camera.fx, want.fx) << want.name;
    EXPECT_EQ(camera.fy, want.fy) << want.name;
    EXPECT_EQ(camera.cx, want.cx) << want.name;
    EXPECT_EQ(camera.cy, want.cy) << want.name;
    EXPECT_EQ(camera.k1, want.k1) << want.name;
    EXPECT_EQ(camera.k2, want.k2) << want.name;
    EXPECT_EQ(camera.p1, want.p1) << want.name;
    EXPECT_EQ(camera.p2, want.p2) << want.name;
    EXPECT_EQ(camera.k3, want.k3) << want.name;
    EXPECT_EQ(camera.width, 640);
    EXPECT_EQ(camera.height, 480);
    EXPECT_EQ(camera.depth_scale, 5000);
    EXPECT_EQ(camera.HasDistortion(), want.k1 != 0);
  }
}

TEST(FindCameraPreset, IsEmptyForAnotherName) {
  for (const char* name : {"", "tum", "tum-fr4", "TUM-FR1", "tum-fr1 "}) {
    EXPECT_FALSE(FindCameraPreset(name).has_value()) << name;
  }
}

TEST(PinholeCamera, UndistortIsTheInverseOfDistortAllOverTheImage) {
  for (const char* name : kPresets) {
    const PinholeCamera camera = Preset(name);
    ForGridOf(camera, [&](const Eigen::Vector2d& pixel) {
      const Eigen::Vector2d ideal = camera.Undistort(pixel);
      ASSERT_LE((camera.Distort(ideal) - pixel).norm(), 1e-6) << name << " " << pixel.transpose();
      ASSERT_LE((camera.Undistort(camera.Distort(ideal)) - ideal).norm(), 1e-6) << name;
    });
  }
}

TEST(PinholeCamera, DistortIsTheBrownConradyModel) {
  PinholeCamera camera = Preset("tum-fr1");
  // At x = 0.3, y = -0.2: r2 = 0.13, worked out by hand from the published formula.
  const double radial = 1 + 0.2624 * 0.13 - 0.9531 * 0.0169 + 1.1633 * 0.002197;
  const double dx = 2 * -0.0054 * -0.06 + 0.0026 * (0.13 + 0.18);
  const double dy = -0.0054 * (0.13 + 0.08) + 2 * 0.0026 * -0.06;
  const Eigen::Vector2d ideal(0.3 * camera.fx + camera.cx, -0.2 * camera.fy + camera.cy);
  const Eigen::Vector2d pixel = camera.Distort(ideal);
  EXPECT_NEAR(pixel.x(), (0.3 * radial + dx) * camera.fx + camera.cx, 1e-10);
  EXPECT_NEAR(pixel.y(), (-0.2 * radial + dy) * camera.fy + camera.cy, 1e-10);
  EXPECT_GT((pixel - ideal).norm(), 1) << "the lens must be seen";
}

TEST(PinholeCamera, WithoutDistortionPixelsAreIdeal) {
  const PinholeCamera camera = Preset("tum-fr3");
  ForGridOf(camera, [&](const Eigen::Vector2d& pixel) {
    ASSERT_EQ(camera.Undistort(pixel), pixel);
    ASSERT_LE((camera.Distort(pixel) - pixel).norm(), 1e-12);
  });
}

TEST(PinholeCamera, UndistortConvergesForAStrongBarrelLens) {
  PinholeCamera camera;
  camera.k1 = -0.28, camera.k2 = 0.07, camera.p1 = 2e-4, camera.p2 = 2e-5;  // EuRoC's left camera
  camera.fx = 458.654, camera.fy = 457.296, camera.cx = 367.215, camera.cy = 248.375;
  camera.width = 752;
  ForGridOf(camera, [&](const Eigen::Vector2d& pixel) {
    ASSERT_LE((camera.Distort(camera.Undistort(pixel)) - pixel).norm(), 1e-6) << pixel.transpose();
  });
}

TEST(PinholeCamera, UnprojectIsTheInverseOfProject) {
  for (const char* name : kPresets) {
    const PinholeCamera camera = Preset(name);
    ForGridOf(camera, [&](const Eigen::Vector2d& pixel) {
      const Eigen::Vector2d ideal = camera.Undistort(pixel);
      const Eigen::Vector3d point_in_camera = camera.UnprojectIdeal(ideal, 2.5);
      ASSERT_EQ(point_in_camera.z(), 2.5);
      ASSERT_LE((camera.ProjectIdeal(point_in_camera) - ideal).norm(), 1e-10) << name;
      ASSERT_LE((camera.Project(point_in_camera) - pixel).norm(), 1e-6) << name;
    });
  }
}

TEST(PinholeCamera, HasAxesRightDownAndForward) {
  const PinholeCamera camera = Preset("tum-fr1");
  const Eigen::Vector2d centre = camera.Project({0, 0, 1});
  EXPECT_LT((centre - Eigen::Vector2d(camera.cx, camera.cy)).norm(), 1e-12);
  EXPECT_GT(camera.Project({0.1, 0, 1}).x(), centre.x());
  EXPECT_GT(camera.Project({0, 0.1, 1}).y(), centre.y());
}

TEST(PinholeCamera, KnowsWhatIsInTheImage) {
  const PinholeCamera camera;
  EXPECT_TRUE(camera.IsInImage({0, 0}));
  EXPECT_TRUE(camera.IsInImage({639, 479}));
  EXPECT_FALSE(camera.IsInImage({-0.01, 0}));
  EXPECT_FALSE(camera.IsInImage({0, 479.01}));
  EXPECT_FALSE(camera.IsInImage({639.5, 0}));
  EXPECT_FALSE(camera.IsInImage({std::numeric_limits<double>::quiet_NaN(), 0}));
}

TEST(PinholeCamera, OptionsReachEveryParameter) {
  using P = PinholeCamera;
  const std::pair<const char*, double P::*> reals[] = {{"depth_delay_s", &P::depth_delay_s},
                                                       {"fx", &P::fx},
                                                       {"fy", &P::fy},
                                                       {"cx", &P::cx},
                                                       {"cy", &P::cy},
                                                       {"k1", &P::k1},
                                                       {"k2", &P::k2},
                                                       {"p1", &P::p1},
                                                       {"p2", &P::p2},
                                                       {"k3", &P::k3},
                                                       {"baseline_m", &P::baseline_m},
                                                       {"depth_scale", &P::depth_scale}};
  PinholeCamera camera;
  const std::vector<OptionField> fields = OptionFields(camera);
  EXPECT_EQ(fields.size(), std::size(reals) + 2);
  double value = 0;
  for (const auto& [name, member] : reals) {
    value += .5;
    ApplyOptionAssignment(std::string(name) + "=" + std::to_string(value), fields);
    EXPECT_EQ(camera.*member, value) << name;
  }
  ApplyOptionAssignment("width=320", fields);
  ApplyOptionAssignment("height=240", fields);
  EXPECT_EQ(camera.width, 320);
  EXPECT_EQ(camera.height, 240);
}

TEST(UndistortionTable, EqualsTheFunctionAtEveryPixel) {
  for (const char* name : kPresets) {
    const PinholeCamera camera = Preset(name);
    const UndistortionTable table(camera);
    for (int row = 0; row < camera.height; row += 7) {
      for (int column = 0; column < camera.width; column += 9) {
        const Eigen::Vector2d ideal = camera.Undistort(Eigen::Vector2d(column, row));
        ASSERT_EQ(table.At(column, row), ideal.cast<float>()) << column << " " << row;
      }
    }
    EXPECT_EQ(table.At(639, 479), camera.Undistort(Eigen::Vector2d(639, 479)).cast<float>());
  }
}

}  // namespace
}  // namespace ofm
