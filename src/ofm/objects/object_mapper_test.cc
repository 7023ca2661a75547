#include "ofm/objects/object_mapper.h"

#include <gtest/gtest.h>

#include "ofm/objects/test_room.h"

namespace ofm {
namespace {

TEST(ObjectMapper, GivesTheSameObjectsInWhateverOrderKeyframesCame) {
  const auto poses = test::Walk(4, -.2, .1);
  const auto frames = test::LookFrom(poses, {test::Wall(), test::Chair()});
  ObjectMapper forward(test::SmallCamera(), {}, test::Policies());
  ObjectMapper backward(test::SmallCamera(), {}, test::Policies());
  for (const auto& [id, frame] : frames) forward.AddKeyframe(frame);
  for (auto it = frames.rbegin(); it != frames.rend(); ++it) backward.AddKeyframe(it->second);
  const ObjectInventory a = forward.Build(poses), b = backward.Build(poses);
  ASSERT_EQ(a.objects.size(), 1U);
  ASSERT_EQ(b.objects.size(), 1U);
  EXPECT_EQ(a.up_in_world, b.up_in_world);
  EXPECT_EQ(a.objects[0].centroid_in_world, b.objects[0].centroid_in_world);
  EXPECT_EQ(a.objects[0].box.size_m, b.objects[0].box.size_m);
}

TEST(ObjectMapper, ReplacesAKeyframeThatComesAgain) {
  const auto poses = test::Walk(2, -.2, .1);
  auto frames = test::LookFrom(poses, {test::Wall(), test::Chair()});
  ObjectMapper mapper(test::SmallCamera(), {}, test::Policies());
  for (const auto& [id, frame] : frames) mapper.AddKeyframe(frame);
  frames[KeyframeId(1)].instances.clear();
  mapper.AddKeyframe(frames[KeyframeId(1)]);
  EXPECT_EQ(mapper.size(), 2U);
  EXPECT_TRUE(mapper.Build(poses).objects.empty());
}

}  // namespace
}  // namespace ofm
