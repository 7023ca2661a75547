#include "ofm/pipeline/back_end.h"

#include <gmock/gmock.h>

#include "ofm/pipeline/test_support.h"

namespace ofm {
namespace {

TEST(FindInstanceObjects, NamesTheObjectOfEachInstanceThatBecameOne) {
  SceneObject cup, chair;
  cup.id = ObjectId(0), chair.id = ObjectId(1);
  cup.sightings = {{KeyframeId(3), 2}};
  chair.sightings = {{KeyframeId(3), 0}, {KeyframeId(5), 1}};
  const std::vector<SceneObject> scene{cup, chair};
  const InstanceObjects objects = FindInstanceObjects(scene);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects.at(KeyframeId(3)), (std::vector<std::uint16_t>{1, kNoInstance, 0}));
  EXPECT_EQ(objects.at(KeyframeId(5)), (std::vector<std::uint16_t>{kNoInstance, 1}));
}

using testing::Contains;
using testing::Key;
using testing::Not;

TEST(BackEnd, DoesNotAdjustAMapWhoseLastChangeWasCutShort) {
  const test::Recording recording(1);
  for (const std::size_t landmarks : {0, 3}) {
    const auto slam = test::MakeSlam(recording);
    BackEnd back_end(*slam);
    KeyframeJob job;
    job.candidate.features = std::make_shared<FrameFeatures>();
    job.candidate.landmarks.resize(landmarks);
    RunOutcome outcome;
    if (landmarks == 0) {
      back_end.Insert(std::move(job));
      back_end.Finish(outcome);
      EXPECT_THAT(back_end.times().stages(), Contains(Key("final_adjustment")));
    } else {
      EXPECT_THROW(back_end.Insert(std::move(job)), std::logic_error) << "more than features";
      back_end.Finish(outcome);
      EXPECT_THAT(back_end.times().stages(), Not(Contains(Key("final_adjustment"))));
    }
    ASSERT_TRUE(outcome.map);
    EXPECT_EQ(outcome.map_is_whole, landmarks == 0);
    EXPECT_TRUE(outcome.semantic_map);
  }
}

}  // namespace
}  // namespace ofm
