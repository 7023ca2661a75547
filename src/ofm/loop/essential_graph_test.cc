#include "ofm/loop/essential_graph.h"

#include <gtest/gtest.h>

#include "ofm/map/test_map.h"

namespace ofm {
namespace {

/// Keyframes in which pairs share as many landmarks as a test wants.
class SharedMap {
 public:
  explicit SharedMap(int keyframes) {
    for (int i = 0; i < keyframes; ++i) map_.AddKeyframe(test::MakePlainKeyframe(300));
    next_feature_.resize(keyframes, 0);
  }
  void Share(std::uint32_t a, std::uint32_t b, int count) {
    for (int i = 0; i < count; ++i) {
      const LandmarkId id = map_.AddLandmark({0, 0, 2}, KeyframeId(a), next_feature_[a]++);
      map_.AddObservation(id, KeyframeId(b), next_feature_[b]++);
    }
  }
  std::vector<CovisibilityEdge> Graph(int strong) {
    return EssentialGraph(*map_.Snapshot(), SubmapId(0), strong);
  }
  Map& map() { return map_; }

 private:
  Map map_{test::TestScales()};
  std::vector<int> next_feature_;
};

CovisibilityEdge Edge(std::uint32_t a, std::uint32_t b, int shared) {
  return {KeyframeId(a), KeyframeId(b), shared};
}

TEST(EssentialGraph, IsATreeOfMostSharedLandmarks) {
  SharedMap shared(4);
  shared.Share(0, 1, 10);
  shared.Share(1, 2, 30);
  shared.Share(0, 2, 20);
  shared.Share(2, 3, 5);
  shared.Share(0, 3, 4);
  const std::vector expected = {Edge(0, 2, 20), Edge(1, 2, 30), Edge(2, 3, 5)};
  EXPECT_EQ(shared.Graph(1000), expected);
}

TEST(EssentialGraph, IsOfOneSubmap) {
  SharedMap shared(2);
  shared.Share(0, 1, 10);
  for (const SubmapId submap : {SubmapId(), SubmapId(0)}) {
    Keyframe keyframe = test::MakePlainKeyframe(3);
    keyframe.submap = submap;
    shared.map().AddKeyframe(keyframe);
  }
  const std::vector expected = {Edge(0, 1, 10), Edge(1, 3, 0)};
  EXPECT_EQ(shared.Graph(1000), expected);
}

TEST(EssentialGraph, StrongPairsAreEdgesBesideTheTree) {
  SharedMap shared(3);
  shared.Share(0, 1, 40);
  shared.Share(1, 2, 30);
  shared.Share(0, 2, 20);
  EXPECT_EQ(shared.Graph(20).size(), 3U);
  EXPECT_EQ(shared.Graph(21).size(), 2U);
}

TEST(EssentialGraph, PartsThatShareNothingAreJoinedInTheirOrder) {
  SharedMap shared(4);
  shared.Share(0, 1, 10);
  shared.Share(2, 3, 10);
  const std::vector expected = {Edge(0, 1, 10), Edge(1, 2, 0), Edge(2, 3, 10)};
  EXPECT_EQ(shared.Graph(100), expected);
}

TEST(EssentialGraph, KnowsNothingOfRemovedKeyframes) {
  SharedMap shared(3);
  shared.Share(0, 1, 10);
  shared.Share(1, 2, 10);
  shared.map().RemoveKeyframe(KeyframeId(1), KeyframeId(0));
  EXPECT_EQ(shared.Graph(100), (std::vector{Edge(0, 2, 0)}));
}

TEST(EssentialGraph, OfOneKeyframeHasNoEdges) { EXPECT_TRUE(SharedMap(1).Graph(1).empty()); }

}  // namespace
}  // namespace ofm
