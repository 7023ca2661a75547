#include "ofm/features/even_distribution.h"

#include <gmock/gmock.h>

#include <set>

#include "ofm/base/random.h"

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Most lie in the left upper tenth, a few everywhere.
std::vector<Corner> CrowdedCorners() {
  RandomEngine engine = MakeRandomEngine(1, 0);
  std::vector<Corner> corners;
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t extent = i < 2400 ? 60 : 600;
    const auto draw = [&](std::uint32_t bound) {
      return static_cast<std::uint16_t>(UniformIndex(engine, bound));
    };
    corners.push_back({draw(extent), draw(extent), static_cast<std::uint16_t>(7 + draw(200))});
  }
  return corners;
}

int OccupiedCells(std::span<const Corner> corners) {
  std::set<std::pair<int, int>> cells;
  for (const Corner& corner : corners) cells.emplace(corner.x / 60, corner.y / 60);
  return static_cast<int>(cells.size());
}

TEST(EvenSelector, GivesTheNumberAskedForFromTheList) {
  const std::vector<Corner> corners = CrowdedCorners();
  EvenSelector selector;
  for (const int count : {1, 7, 200, 2999}) {
    const std::vector<Corner> selected = selector.Select(corners, count, 0.5);
    EXPECT_EQ(static_cast<int>(selected.size()), count);
    EXPECT_THAT(corners, ::testing::IsSupersetOf(selected));
  }
}

TEST(EvenSelector, SpreadsThemWiderThanTheStrongest) {
  std::vector<Corner> corners = CrowdedCorners();
  const std::vector<Corner> selected = EvenSelector().Select(corners, 150, 1);
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.score > b.score; });
  corners.resize(150);
  EXPECT_GT(OccupiedCells(selected), 1.5 * OccupiedCells(corners));
}

TEST(EvenSelector, WithoutEvennessTakesTheStrongest) {
  std::vector<Corner> corners = CrowdedCorners();
  const std::vector<Corner> selected = EvenSelector().Select(corners, 150, 0);
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.score > b.score; });
  corners.resize(150);
  EXPECT_EQ(selected, corners);
}

TEST(EvenSelector, MoreEvennessCoversMore) {
  const std::vector<Corner> corners = CrowdedCorners();
  EvenSelector selector;
  const int none = OccupiedCells(selector.Select(corners, 150, 0));
  const int half = OccupiedCells(selector.Select(corners, 150, 0.5));
  const int all = OccupiedCells(selector.Select(corners, 150, 1));
  EXPECT_LT(none, half);
  EXPECT_LT(half, all);
}

TEST(EvenSelector, KeepsTheStrongestCorner) {
  std::vector<Corner> corners = CrowdedCorners();
  corners[1234].score = 255;
  EXPECT_EQ(EvenSelector().Select(corners, 5, 1).front(), corners[1234]);
}

TEST(EvenSelector, GivesAllWhereThereAreTooFew) {
  const std::vector<Corner> corners = {{10, 10, 8}, {11, 10, 30}};
  EXPECT_THAT(EvenSelector().Select(corners, 5, 1), ElementsAre(corners[1], corners[0]));
  EXPECT_THAT(EvenSelector().Select(corners, 0, 1), IsEmpty());
  EXPECT_THAT(EvenSelector().Select({}, 5, 1), IsEmpty());
}

TEST(DropWeakWhereStrong, DropsTheWeakInCellsWithAStrongOneOnly) {
  std::vector<Corner> corners = {{5, 5, 9}, {25, 5, 40}, {35, 5, 8}, {29, 29, 19}, {30, 30, 20}};
  DropWeakWhereStrong(corners, 20, 30);
  EXPECT_THAT(corners, ElementsAre(Corner{25, 5, 40}, Corner{35, 5, 8}, Corner{30, 30, 20}));
}

TEST(AllocateCounts, FollowsTheWeights) {
  EXPECT_THAT(AllocateCounts(std::vector{1000, 1000, 1000}, std::vector{4.0, 2.0, 1.0}, 70),
              ElementsAre(40, 20, 10));
}

TEST(AllocateCounts, GivesToTheOthersWhatOneLacks) {
  EXPECT_THAT(AllocateCounts(std::vector{1000, 5, 1000}, std::vector{1.0, 1.0, 1.0}, 65),
              ElementsAre(30, 5, 30));
}

TEST(AllocateCounts, EndsWhereAllIsGiven) {
  EXPECT_THAT(AllocateCounts(std::vector{3, 0, 2}, std::vector{1.0, 1.0, 1.0}, 65),
              ElementsAre(3, 0, 2));
}

}  // namespace
}  // namespace ofm
