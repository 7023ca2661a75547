#include "ofm/sim/floor_graph.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ofm {
namespace {

/// A square with a long detour and a place that nothing leads to.
FloorGraph Square() { return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {9, 9}}, {{0, 1}, {1, 2}, {2, 3}}}; }

TEST(FloorGraph, ShortestWayNamesThePlacesAfterTheStart) {
  EXPECT_EQ(Square().ShortestWay(0, 3), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(Square().ShortestWay(3, 1), (std::vector<int>{2, 1}));
}

TEST(FloorGraph, ShortestWayIsByLengthAndNotByPlaces) {
  FloorGraph graph = Square();
  graph.places.push_back({0.5, 5});
  graph.ways.insert(graph.ways.end(), {{0, 5}, {5, 3}});
  EXPECT_EQ(graph.ShortestWay(0, 3).size(), 3U);
}

TEST(FloorGraph, NoWayIsEmpty) {
  EXPECT_TRUE(Square().ShortestWay(0, 4).empty());
  EXPECT_TRUE(Square().ShortestWay(2, 2).empty());
}

TEST(FloorGraph, NearestPlace) {
  EXPECT_EQ(Square().Nearest({0.9, 0.8}), 2);
  EXPECT_THROW(FloorGraph().Nearest({0, 0}), std::logic_error);
}

}  // namespace
}  // namespace ofm
