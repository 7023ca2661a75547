#include "ofm/pipeline/octree_upkeep.h"

#include <gtest/gtest.h>

#include <sstream>

#include "ofm/dense/octree_file.h"
#include "ofm/dense/ply_file.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

/// The files that a map becomes.
std::string Bytes(const SemanticOctree& octree) {
  std::ostringstream stream;
  WriteColorOcTree(stream, octree);
  WriteBinaryOcTree(stream, octree);
  WriteVoxelLabels(stream, octree, {});
  return stream.str();
}

std::string Bytes(const SemanticMap& map) {
  std::ostringstream stream;
  WritePly(stream, map.cloud_in_world, {});
  return stream.str() + Bytes(map.octree);
}

/// Clouds of a patch of wall, 2 m ahead.
KeyframeClouds MakeClouds(std::uint32_t count) {
  KeyframeClouds clouds;
  for (std::uint32_t id = 0; id < count; ++id) {
    KeyframeCloud cloud;
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3f position(.025F * static_cast<float>(i % 20),
                                     .025F * static_cast<float>(i / 20), 2);
      cloud.points_in_camera.push_back({position, {9, 8, 7}, static_cast<std::uint8_t>(id), 200});
    }
    clouds[KeyframeId(id)] = std::make_shared<const KeyframeCloud>(cloud);
  }
  return clouds;
}

KeyframePoseMap MakePoses(std::uint32_t count, double step_m) {
  KeyframePoseMap poses;
  for (std::uint32_t id = 0; id < count; ++id) {
    poses[KeyframeId(id)] = {Eigen::Quaterniond::Identity(), {step_m * id, 0, 0}};
  }
  return poses;
}

/// As a run goes: one key frame more at each update, and all of them somewhere else.
std::string KeepUp() {
  constexpr std::uint32_t kCount = 12;
  const KeyframeClouds clouds = MakeClouds(kCount);
  OctreeUpkeep upkeep{DenseOptions()};
  for (std::uint32_t count = 1; count <= kCount; ++count) {
    upkeep.Update(clouds, MakePoses(count, .1 + .02 * count));
  }
  return Bytes(upkeep.Finish(clouds, MakePoses(kCount, .15)));
}

TEST(OctreeUpkeep, TheOctreeInTheEndIsThatOfTheFinalPoses) {
  OctreeIntegrator at_once{DenseOptions()};
  at_once.Update(MakeClouds(12), MakePoses(12, .15), 0);
  EXPECT_EQ(KeepUp(), Bytes(at_once.octree()));
}

TEST(OctreeUpkeep, NothingNeedsToHaveBeenUpdated) {
  OctreeUpkeep upkeep{DenseOptions()};
  EXPECT_FALSE(upkeep.Finish(MakeClouds(2), MakePoses(2, .1)).empty());
}

/// The semantic map of a run, and the one built at once from the poses that the run ended with.
void ExpectMapOfTheFinalPoses(Slam& slam, const RunOutcome& outcome) {
  ASSERT_TRUE(outcome.semantic_map);
  KeyframePoseMap poses;
  for (std::uint32_t id = 0; id < outcome.counts.keyframes_made; ++id) {
    const auto pose = outcome.map->FindKeyframePose(KeyframeId(id));
    if (pose) poses[KeyframeId(id)] = pose->Inverse();
  }
  EXPECT_GT(poses.size(), 3U);
  EXPECT_TRUE(Bytes(*outcome.semantic_map) == Bytes(slam.semantic_mapper().Build(poses)));
}

TEST(OctreeUpkeep, BothRunnersEndWithTheMapOfTheFinalPoses) {
  const test::Recording recording(16);
  for (const auto run :
       {+[](Slam&slam, FrameSource&source) { return RunSequential(slam, source, {}); },
        +[](Slam&slam, FrameSource&source) { return RunThreaded(slam, source, {}); }}) {
    test::PlaySource source(recording.images);
    const auto slam = test::MakeSlam(recording, test::KeyframesOften());
    const RunOutcome outcome = run(*slam, source);
    EXPECT_EQ(outcome.error, "");
    EXPECT_TRUE(outcome.times.stages().contains("octree_upkeep"));
    ExpectMapOfTheFinalPoses(*slam, outcome);
  }
}

TEST(OctreeUpkeep, LeavingAllToTheEndGivesTheSameMap) {
  const test::Recording recording(10);
  std::vector<std::string> maps;
  for (const OctreeUpkeepTime time : {OctreeUpkeepTime::kWhileRunning, OctreeUpkeepTime::kAtEnd}) {
    SlamOptions options = test::KeyframesOften();
    options.dense.octree.upkeep = time;
    test::PlaySource source(recording.images);
    const RunOutcome outcome = RunSequential(*test::MakeSlam(recording, options), source, {});
    EXPECT_EQ(outcome.times.stages().contains("octree_upkeep"),
              time == OctreeUpkeepTime::kWhileRunning);
    maps.push_back(Bytes(*outcome.semantic_map));
  }
  EXPECT_TRUE(maps[0] == maps[1]);
}

/// Runs with at most `limit` clouds of key frames that the map let go; gives those that are held.
std::vector<KeyframeId> SpareClouds(const test::Recording& recording, int limit) {
  SlamOptions options = test::KeyframesOften();
  options.mapping.redundant_share = .2;  // lets many go
  options.dense.max_spare_clouds = limit;
  test::PlaySource source(recording.images);
  const auto slam = test::MakeSlam(recording, options);
  const RunOutcome outcome = RunSequential(*slam, source, {});
  EXPECT_EQ(outcome.error, "");
  ExpectMapOfTheFinalPoses(*slam, outcome);
  std::vector<KeyframeId> spare;
  for (const auto& [id, cloud] : slam->semantic_mapper().clouds()) {
    if (outcome.map->keyframes.Find(id) == nullptr) spare.push_back(id);
  }
  return spare;
}

TEST(OctreeUpkeep, OfKeyframesThatTheMapLetGoTheNewestCloudsAreHeld) {
  const test::Recording recording(24);
  const std::vector<KeyframeId> all = SpareClouds(recording, 1000);
  const std::vector<KeyframeId> some = SpareClouds(recording, 4);
  ASSERT_GT(all.size(), 4U);
  EXPECT_LE(some.size(), 4U);
  EXPECT_GE(some.size(), 3U) << "a quarter goes at once";
  EXPECT_EQ(some, std::vector<KeyframeId>(all.end() - some.size(), all.end()));
  EXPECT_TRUE(SpareClouds(recording, 0).empty());
}

}  // namespace
}  // namespace ofm
