#include "ofm/io/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/base/error.h"
#include "ofm/io/test_folder.h"

namespace ofm {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kJson = R"({
 "width": 640,
 "height": 480,
 "fx": 517.3, "fy": 516.5, "cx": 318.6, "cy": 255.3,
 "distortion": [0.2624, -0.9531, -0.0054, 0.0026, 1.1633],
 "depth_scale": 5000.0
})";
constexpr const char* kSize = "\"width\": 640, \"height\": 480";

std::string ErrorOfJson(const std::string& text) {
  const TestFolder folder;
  const auto path = folder.Write("camera.json", text);
  return ErrorOf([&] { LoadCamera(path); });
}

std::string ErrorOfYaml(const std::string& text) {
  const TestFolder folder;
  const auto path = folder.Write("camera.yaml", text);
  return ErrorOf([&] { LoadCamera(path); });
}

TEST(CameraFile, ReadsJson) {
  const TestFolder folder;
  const PinholeCamera camera = LoadCamera(folder.Write("camera.json", kJson));
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.fx, 517.3);
  EXPECT_EQ(camera.fy, 516.5);
  EXPECT_EQ(camera.cx, 318.6);
  EXPECT_EQ(camera.cy, 255.3);
  EXPECT_EQ(camera.k1, 0.2624);
  EXPECT_EQ(camera.k2, -0.9531);
  EXPECT_EQ(camera.p1, -0.0054);
  EXPECT_EQ(camera.p2, 0.0026);
  EXPECT_EQ(camera.k3, 1.1633);
  EXPECT_EQ(camera.depth_scale, 5000);
  EXPECT_EQ(camera.baseline_m, PinholeCamera().baseline_m);
}

TEST(CameraFile, ReadsYaml) {
  const TestFolder folder;
  const PinholeCamera camera = LoadCamera(
      folder.Write("c.yaml",
                   "width: 320\nheight: 240\nfx: 262\nfy: 263\ncx: 160\ncy: 120\np2: -0.25\n"
                   "depth_scale: 1000\nbaseline_m: 0.05\n"));
  EXPECT_EQ(camera.width, 320);
  EXPECT_EQ(camera.height, 240);
  EXPECT_EQ(camera.fy, 263);
  EXPECT_EQ(camera.p2, -0.25);
  EXPECT_EQ(camera.depth_scale, 1000);
  EXPECT_EQ(camera.baseline_m, 0.05);
}

TEST(CameraFile, WhatAProgramPrintsIsReadBack) {
  PinholeCamera camera = *FindCameraPreset("tum-fr2");
  const TestFolder folder;
  const auto path = folder.Write("c.yaml", PrintOptionsYaml(OptionFields(camera)));
  const PinholeCamera back = LoadCamera(path);
  EXPECT_EQ(back.fx, camera.fx);
  EXPECT_EQ(back.k3, camera.k3);
}

TEST(CameraFile, NamesTheLineOfBadJson) {
  EXPECT_THAT(ErrorOfJson("{\n \"width\": 640,\n \"height\": }\n"),
              EndsWith("camera.json:3: is not valid JSON"));
  EXPECT_THAT(ErrorOfJson("[1]"), HasSubstr("camera.json:1: must hold an object"));
  EXPECT_THAT(ErrorOfJson(""), EndsWith("camera.json:1: is not valid JSON"));
  EXPECT_THAT(ErrorOfJson("{\n \"widht\": 640}"), EndsWith("camera.json:2: widht: unknown key"));
  EXPECT_THAT(ErrorOfJson("{\n\n \"fx\": \"wide\"}"),
              EndsWith("camera.json:3: fx: \"wide\" is no number"));
  EXPECT_THAT(ErrorOfJson("{\"fx\": -5}"), HasSubstr("camera.json:1: fx: -5 is outside [1, "));
  EXPECT_THAT(ErrorOfJson("{\"width\": 640.5}"), HasSubstr("is not a whole number"));
  EXPECT_THAT(ErrorOfJson("{\"distortion\": [1, 2]}"), HasSubstr("must be a list [k1, k2"));
  EXPECT_THAT(ErrorOfJson("{\"distortion\": [1, 2, null, 4, 5]}"), HasSubstr("is no number"));
}

TEST(CameraFile, NamesTheLineOfBadYaml) {
  EXPECT_THAT(ErrorOfYaml("width: 640\nwidht: 640\n"),
              HasSubstr("camera.yaml:2: unknown key 'widht'"));
  EXPECT_THAT(ErrorOfYaml("fx: .nan\n"), HasSubstr("camera.yaml:1: fx: "));
}

TEST(CameraFile, AnIncompleteCameraIsAnError) {
  EXPECT_THAT(ErrorOfJson(std::string("{") + kSize + "}"),
              EndsWith("camera.json: has no fx, fy, cx, cy; add it"));
  EXPECT_THAT(ErrorOfYaml("fx: 500\nfy: 500\ncx: 320\ncy: 240\n"),
              EndsWith("camera.yaml: has no width, height; add it"));
  EXPECT_THAT(ErrorOfYaml(""), HasSubstr("has no width, height, fx, fy, cx, cy"));
}

TEST(ResolveCamera, KnowsPresets) {
  EXPECT_EQ(ResolveCamera("tum-fr1", "/none").fx, FindCameraPreset("tum-fr1")->fx);
}

TEST(ResolveCamera, AutoFindsTheFileBesideTheSequence) {
  const TestFolder folder;
  folder.Write("camera.yaml", "width: 320\nheight: 240\nfx: 262\nfy: 263\ncx: 160\ncy: 120\n");
  EXPECT_EQ(ResolveCamera("auto", folder.path()).width, 320);
  folder.Write("camera.json", kJson);
  EXPECT_EQ(ResolveCamera("auto", folder.path()).width, 640);
}

TEST(ResolveCamera, TakesAPath) {
  const TestFolder folder;
  EXPECT_EQ(ResolveCamera(folder.Write("my.json", kJson), "/none").fx, 517.3);
}

TEST(ResolveCamera, ListsWhatCanBeGiven) {
  const TestFolder folder;
  EXPECT_THAT(ErrorOf([&] { ResolveCamera("auto", folder.path()); }),
              AllOf(HasSubstr(folder.path().string() + ": has neither camera.json nor"),
                    HasSubstr("tum-fr1, tum-fr2, tum-fr3")));
  EXPECT_THAT(ErrorOf([&] { ResolveCamera("tum-fr9", folder.path()); }),
              AllOf(HasSubstr("'tum-fr9' is neither"), HasSubstr("tum-fr1, tum-fr2, tum-fr3"),
                    HasSubstr("auto")));
}

}  // namespace
}  // namespace ofm
