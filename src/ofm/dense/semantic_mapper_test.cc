#include "ofm/dense/semantic_mapper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "ofm/base/error.h"
#include "ofm/dense/octree_file.h"
#include "ofm/dense/ply_file.h"
#include "ofm/dense/test_scene.h"

namespace ofm {
namespace {

using test::At, test::Chair, test::Person, test::SmallCamera, test::Wall;
using Poses = KeyframePoseMap;

/// Where the person stood: half a voxel behind the front of Person(0).
const Eigen::Vector3f kPersonPlace(0, 0, 1.525f);
const Eigen::Vector3f kChairPlace(.6f, 0, 2.025f);
const Eigen::Vector3f kWallPlace(-.7f, .2f, 3.025f);

LabelledFrame Render(const std::vector<test::Box>& boxes, std::uint32_t id,
                     const RigidTransform& pose = {}) {
  return test::Render(SmallCamera(), boxes, pose, KeyframeId(id));
}

TEST(SemanticMapper, StaticThingsAreMappedWithTheirLabels) {
  SemanticMapper mapper(SmallCamera(), {});
  Poses poses;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const RigidTransform pose = At(.05 * i, 0, .1);
    mapper.AddKeyframe(Render({Wall(), Chair()}, i, pose));
    poses[KeyframeId(i)] = pose;
  }
  const SemanticMap map = mapper.Build(poses);
  EXPECT_TRUE(map.octree.IsOccupied(kChairPlace));
  EXPECT_TRUE(map.octree.IsOccupied(kWallPlace));
  EXPECT_FALSE(map.octree.IsOccupied({0, 0, 1.5f}));
  EXPECT_EQ(map.octree.Find(kChairPlace)->class_id, test::kChair);
  EXPECT_EQ(map.octree.Find(kChairPlace)->color, test::kRed);
  EXPECT_EQ(map.octree.Find(kWallPlace)->class_id, kNoLabel);
  ASSERT_GT(map.cloud_in_world.size(), 1000u);
  for (const LabelledPoint& point : map.cloud_in_world) {
    const bool on_chair = point.class_id == test::kChair;
    EXPECT_NEAR(point.position.z(), on_chair ? 2.02 : 3.02, 1e-3);
  }
}

TEST(SemanticMapper, WhoWalksAboutWithAMaskNeverEnters) {
  SemanticMapper mapper(SmallCamera(), {});
  Poses poses;
  for (std::uint32_t i = 0; i < 6; ++i) {
    mapper.AddKeyframe(Render({Wall(), Chair(), Person(.15 * i - .4)}, i));
    poses[KeyframeId(i)] = RigidTransform();
  }
  const SemanticMap map = mapper.Build(poses);
  map.octree.ForEach([](const VoxelIndex& voxel, const SemanticVoxel& state) {
    if (state.IsOccupied()) {
      ASSERT_GE(voxel.z(), 40);
    }  // 2 m
  });
  // What the person hid is filled from the frames before and after.
  EXPECT_TRUE(map.octree.IsOccupied({0, 0, 3.025f}));
  EXPECT_TRUE(map.octree.IsOccupied(kChairPlace));
}

TEST(SemanticMapper, MaskedPixelsFreeNothing) {
  SemanticMapper mapper(SmallCamera(), {});
  mapper.AddKeyframe(Render({Wall(), Person(0)}, 0));
  const SemanticMap map = mapper.Build({{KeyframeId(0), RigidTransform()}});
  EXPECT_FALSE(map.octree.Find(Eigen::Vector3f(0, 0, 1)));
  EXPECT_FALSE(map.octree.Find(kPersonPlace));
  EXPECT_FALSE(map.octree.Find(Eigen::Vector3f(0, 0, 2)));
}

TEST(SemanticMapper, ResidueOfAMissedMaskIsClearedInOctreeAndCloud) {
  SemanticMapper mapper(SmallCamera(), {});
  Poses poses;
  LabelledFrame missed = Render({Wall(), Person(0)}, 0);
  missed.dynamic_mask = cv::Scalar(0);
  mapper.AddKeyframe(missed);
  poses[KeyframeId(0)] = RigidTransform();
  const auto has_person = [&](const SemanticMap& map) {
    const auto near = [](const LabelledPoint& p) { return p.position.z() < 2; };
    return std::any_of(map.cloud_in_world.begin(), map.cloud_in_world.end(), near);
  };
  EXPECT_TRUE(mapper.Build(poses).octree.IsOccupied(kPersonPlace));
  EXPECT_TRUE(has_person(mapper.Build(poses)));
  for (std::uint32_t i = 1; i < 4; ++i) {
    mapper.AddKeyframe(Render({Wall(), Person(5)}, i));
    poses[KeyframeId(i)] = RigidTransform();
  }
  EXPECT_FALSE(mapper.Build(poses).octree.IsOccupied(kPersonPlace));
  EXPECT_FALSE(has_person(mapper.Build(poses)));
}

TEST(SemanticMapper, TheMapFollowsThePosesGivenLast) {
  SemanticMapper mapper(SmallCamera(), {});
  mapper.AddKeyframe(Render({Wall(), Chair()}, 0));
  const RigidTransform moved(ExpSo3({0, M_PI / 2, 0}), {1, 0, 0});  // looks along x
  const SemanticMap map = mapper.Build({{KeyframeId(0), moved}});
  EXPECT_TRUE(map.octree.IsOccupied({1 + 2.025f, 0, -.6f}));
  EXPECT_FALSE(map.octree.IsOccupied(kChairPlace));
}

TEST(SemanticMapper, KeyframesWithoutAUsablePoseAreLeftOut) {
  SemanticMapper mapper(SmallCamera(), {});
  for (std::uint32_t i = 0; i < 4; ++i) mapper.AddKeyframe(Render({Wall(), Chair()}, i));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Poses bad{{KeyframeId(1), At(nan, 0, 0)}, {KeyframeId(2), At(0, 1e12, 0)}};
  const SemanticMap nothing = mapper.Build(bad);
  EXPECT_TRUE(nothing.octree.empty());
  EXPECT_TRUE(nothing.cloud_in_world.empty());
  Poses one_good = bad;
  one_good[KeyframeId(3)] = RigidTransform();
  EXPECT_TRUE(mapper.Build(one_good).octree.IsOccupied(kChairPlace));
}

TEST(SemanticMapper, NoKeyframesGiveAnEmptyMapThatCanBeWritten) {
  const SemanticMap map = SemanticMapper(SmallCamera(), {}).Build({});
  EXPECT_TRUE(map.cloud_in_world.empty());
  std::ostringstream ply, ot, bt;
  EXPECT_NO_THROW(WritePly(ply, map.cloud_in_world, {}));
  EXPECT_NO_THROW(WriteColorOcTree(ot, map.octree));
  EXPECT_NO_THROW(WriteBinaryOcTree(bt, map.octree));
}

TEST(SemanticMapper, KeyframesCanBeReplacedAndRemoved) {
  SemanticMapper mapper(SmallCamera(), {});
  mapper.AddKeyframe(Render({Wall(), Chair()}, 0));
  const std::size_t bytes = mapper.MemoryBytes();
  EXPECT_GT(bytes, 10000u);
  mapper.AddKeyframe(Render({Chair()}, 0));
  EXPECT_EQ(mapper.size(), 1u);
  EXPECT_LT(mapper.MemoryBytes(), bytes);
  mapper.RemoveKeyframe(KeyframeId(7));
  mapper.RemoveKeyframe(KeyframeId(0));
  EXPECT_EQ(mapper.size(), 0u);
  EXPECT_EQ(mapper.MemoryBytes(), 0u);
}

TEST(SemanticMapper, TheOrderOfAddingDoesNotMatter) {
  const auto write = [](const std::vector<std::uint32_t>& order) {
    SemanticMapper mapper(SmallCamera(), {});
    Poses poses;
    for (const std::uint32_t i : order) {
      const RigidTransform pose = At(.03 * i, .01 * i, 0);
      mapper.AddKeyframe(Render({Wall(), Chair(), Person(.2 * i)}, i, pose));
      poses[KeyframeId(i)] = pose;
    }
    const SemanticMap map = mapper.Build(poses);
    std::ostringstream stream;
    WritePly(stream, map.cloud_in_world, {});
    WriteColorOcTree(stream, map.octree);
    return stream.str();
  };
  EXPECT_EQ(write({0, 1, 2}), write({2, 0, 1}));
}

TEST(SemanticMapper, PointsAreOfTheObjectThatTheirInstanceIs) {
  SemanticMapper mapper(SmallCamera(), {});
  Poses poses;
  for (std::uint32_t i = 0; i < 3; ++i) {
    LabelledFrame frame = Render({Wall(), Chair()}, i);
    frame.instances = cv::Mat(frame.depth_m.size(), CV_16UC1, cv::Scalar(kNoInstance));
    frame.instances.setTo(i, frame.class_ids == test::kChair);
    mapper.AddKeyframe(frame);
    poses[KeyframeId(i)] = RigidTransform();
  }
  // The chair is instance 0, 1 and 2; of the last frame's nothing became an object.
  const InstanceObjects objects{{KeyframeId(0), {7}}, {KeyframeId(1), {3, 7}}};
  std::size_t on_chair = 0;
  for (const LabelledPoint& point : mapper.Build(poses, objects).cloud_in_world) {
    EXPECT_EQ(point.instance, point.class_id == test::kChair ? 7 : kNoInstance);
    on_chair += point.instance == 7;
  }
  EXPECT_GT(on_chair, 100u);
  for (const LabelledPoint& point : mapper.Build(poses).cloud_in_world) {
    EXPECT_EQ(point.instance, kNoInstance);
  }
}

TEST(SemanticMapper, AFrameWithoutIdIsAProgrammersError) {
  SemanticMapper mapper(SmallCamera(), {});
  LabelledFrame frame = Render({Wall()}, 0);
  frame.id = KeyframeId();
  EXPECT_THROW(mapper.AddKeyframe(frame), std::logic_error);
}

TEST(SemanticMapper, ResolutionsOfNothingAndOfTenMetresAreErrors) {
  for (const double resolution : {0., 10.}) {
    DenseOptions options;
    options.resolution_m = resolution;
    EXPECT_THROW(SemanticMapper(SmallCamera(), options), Error);
  }
}

}  // namespace
}  // namespace ofm
