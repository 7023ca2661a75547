#include "ofm/pipeline/dense_upkeep.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "ofm/dense/octree_file.h"
#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

class DenseUpkeepTest : public testing::TestWithParam<UpkeepThread> {
 protected:
  DenseUpkeep Make() { return {slam_->semantic_mapper(), slam_->object_mapper(), GetParam()}; }

  /// A key frame with its frame as the only view, where it is.
  DenseUpdate MakeUpdate(std::uint32_t id) {
    const RgbdFrame& image = recording_.images[id % recording_.images.size()];
    DenseJob job;
    job.labelled.id = KeyframeId(id);
    job.labelled.color = image.color;
    job.labelled.depth_m = image.depth_m;
    job.views = {job.labelled};
    job.instances.id = KeyframeId(id);
    job.instances.color = image.color;
    job.instances.depth_m = image.depth_m;
    poses_[KeyframeId(id)] = RigidTransform();
    return {{job}, slam_->mapper().Snapshot(), poses_};
  }

  test::Recording recording_{3};
  std::unique_ptr<Slam> slam_ = test::MakeSlam(recording_);
  KeyframePoseMap poses_;
};

/// More than may wait, and more than may wait with their views.
TEST_P(DenseUpkeepTest, NoKeyframeIsLostHoweverManyWait) {
  DenseUpkeep upkeep = Make();
  constexpr std::uint32_t kCount = 40;
  for (std::uint32_t id = 0; id < kCount; ++id) upkeep.Update(MakeUpdate(id));
  EXPECT_EQ(upkeep.Finish(), nullptr);
  EXPECT_EQ(slam_->semantic_mapper().size(), kCount);
  EXPECT_EQ(upkeep.times().stages().at("object_observation").cpu_ms.size(), kCount);
  std::ostringstream octree, expected;
  WriteColorOcTree(octree, upkeep.FinishOctree(poses_));
  WriteColorOcTree(expected, slam_->semantic_mapper().Build(poses_).octree);
  EXPECT_EQ(octree.str(), expected.str());
}

TEST_P(DenseUpkeepTest, AnErrorIsThrownOrGivenOnceAndWhatCameBeforeItIsKept) {
  DenseUpkeep upkeep = Make();
  upkeep.Update(MakeUpdate(0));
  DenseUpdate bad = MakeUpdate(1);
  bad.jobs[0].labelled.color = cv::Mat();
  bool was_thrown = false;
  try {
    upkeep.Update(bad);
    for (std::uint32_t id = 2; id < 30; ++id) upkeep.Update(MakeUpdate(id));
  } catch (const std::logic_error&) {
    was_thrown = true;
  }
  const std::exception_ptr error = upkeep.Finish();
  EXPECT_NE(was_thrown, error != nullptr);
  if (error) {
    EXPECT_THROW(std::rethrow_exception(error), std::logic_error);
  }
  EXPECT_EQ(upkeep.Finish(), nullptr);
  EXPECT_EQ(slam_->semantic_mapper().size(), 1U);
  EXPECT_FALSE(upkeep.FinishOctree(poses_).empty());
}

TEST_P(DenseUpkeepTest, NothingNeedsToHaveBeenUpdated) {
  DenseUpkeep upkeep = Make();
  EXPECT_EQ(upkeep.Finish(), nullptr);
  EXPECT_TRUE(upkeep.FinishOctree({}).empty());
  EXPECT_TRUE(upkeep.times().stages().empty());
}

TEST_P(DenseUpkeepTest, ItsThreadEndsWithIt) {
  DenseUpkeep upkeep = Make();
  for (std::uint32_t id = 0; id < 5; ++id) upkeep.Update(MakeUpdate(id));
}

INSTANTIATE_TEST_SUITE_P(Threads, DenseUpkeepTest,
                         testing::Values(UpkeepThread::kCaller, UpkeepThread::kBackground),
                         [](const auto& test) {
                           return test.param == UpkeepThread::kCaller ? "Caller" : "Background";
                         });

}  // namespace
}  // namespace ofm
