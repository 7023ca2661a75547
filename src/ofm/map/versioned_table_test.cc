#include "ofm/map/versioned_table.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <stdexcept>

#include "ofm/base/ids.h"
#include "ofm/base/random.h"

namespace ofm {
namespace {

struct Item {
  LandmarkId id;
  int value = 0;
};
using Table = VersionedTable<LandmarkId, Item>;
using Snapshot = TableSnapshot<LandmarkId, Item>;

LandmarkId Insert(Table& table, int value) { return table.Insert({{}, value}); }

template <class Source>
std::map<std::uint32_t, int> Contents(const Source& source) {
  std::map<std::uint32_t, int> contents;
  source.ForEach([&](const Item& item) { contents[item.id.value] = item.value; });
  return contents;
}

TEST(VersionedTable, IssuesIdsInIncreasingOrder) {
  Table table;
  EXPECT_EQ(Insert(table, 7), LandmarkId(0));
  EXPECT_EQ(Insert(table, 8), LandmarkId(1));
  EXPECT_EQ(table.Get(LandmarkId(1)).id, LandmarkId(1));
  EXPECT_EQ(table.Get(LandmarkId(1)).value, 8);
}

TEST(VersionedTable, NeverIssuesAnErasedIdAgain) {
  Table table;
  table.Erase(Insert(table, 7));
  EXPECT_EQ(Insert(table, 8), LandmarkId(1));
  EXPECT_EQ(table.Find(LandmarkId(0)), nullptr);
}

TEST(VersionedTable, FindsNothingWhereThereIsNothing) {
  Table table;
  Insert(table, 7);
  EXPECT_EQ(table.Find(LandmarkId(1)), nullptr);
  EXPECT_EQ(table.Find(LandmarkId()), nullptr);
  EXPECT_EQ(table.Snapshot().Find(LandmarkId(1)), nullptr);
  EXPECT_EQ(table.Snapshot().Find(LandmarkId()), nullptr);
  EXPECT_EQ(Snapshot().Find(LandmarkId(0)), nullptr);
}

TEST(VersionedTable, RefusesToTouchWhatIsGone) {
  Table table;
  const LandmarkId id = Insert(table, 7);
  table.Erase(id);
  EXPECT_THROW(table.Get(id), std::logic_error);
  EXPECT_THROW(table.Edit(id), std::logic_error);
  EXPECT_THROW(table.Erase(id), std::logic_error);
  EXPECT_THROW(table.Edit(LandmarkId()), std::logic_error);
}

TEST(VersionedTable, CountsWhatIsThere) {
  Table table;
  EXPECT_EQ(table.size(), 0U);
  Insert(table, 1);
  const LandmarkId second = Insert(table, 2);
  EXPECT_EQ(table.size(), 2U);
  table.Erase(second);
  EXPECT_EQ(table.size(), 1U);
}

TEST(VersionedTable, VisitsByIncreasingIdAndSkipsTheErased) {
  Table table;
  for (int i = 0; i < 5; ++i) Insert(table, 10 * i);
  table.Erase(LandmarkId(2));
  std::vector<int> visited;
  table.ForEach([&](const Item& item) { visited.push_back(item.value); });
  EXPECT_EQ(visited, (std::vector<int>{0, 10, 30, 40}));
  visited.clear();
  table.Snapshot().ForEach([&](const Item& item) { visited.push_back(item.value); });
  EXPECT_EQ(visited, (std::vector<int>{0, 10, 30, 40}));
}

TEST(VersionedTable, SnapshotKeepsWhatIsEditedOrErasedLater) {
  Table table;
  const LandmarkId edited = Insert(table, 1), erased = Insert(table, 2);
  const Snapshot snapshot = table.Snapshot();
  table.Edit(edited).value = 10;
  table.Erase(erased);
  Insert(table, 3);
  EXPECT_EQ(Contents(snapshot), (std::map<std::uint32_t, int>{{0, 1}, {1, 2}}));
  EXPECT_EQ(Contents(table), (std::map<std::uint32_t, int>{{0, 10}, {2, 3}}));
}

TEST(VersionedTable, EarlierSnapshotIsKeptAfterALaterOne) {
  Table table;
  const LandmarkId id = Insert(table, 1);
  const Snapshot first = table.Snapshot();
  table.Edit(id).value = 2;
  const Snapshot second = table.Snapshot();
  table.Edit(id).value = 3;
  EXPECT_EQ(first.Find(id)->value, 1);
  EXPECT_EQ(second.Find(id)->value, 2);
  EXPECT_EQ(table.Get(id).value, 3);
}

TEST(VersionedTable, CopiesAnObjectOnceAfterASnapshotAndOnlyWhenEdited) {
  Table table;
  const LandmarkId edited = Insert(table, 1), untouched = Insert(table, 2);
  EXPECT_EQ(&table.Edit(edited), table.Find(edited)) << "no snapshot, no copy";
  const Snapshot snapshot = table.Snapshot();
  const Item* copy = &table.Edit(edited);
  EXPECT_NE(copy, snapshot.Find(edited));
  EXPECT_EQ(&table.Edit(edited), copy) << "the second edit needs no copy";
  EXPECT_EQ(table.Find(untouched), snapshot.Find(untouched)) << "shared";
}

TEST(VersionedTable, SnapshotOutlivesTheTable) {
  Snapshot snapshot;
  {
    Table table;
    Insert(table, 4);
    snapshot = table.Snapshot();
  }
  EXPECT_EQ(snapshot.Find(LandmarkId(0))->value, 4);
}

TEST(VersionedTable, SnapshotsNeverChangeUnderRandomEdits) {
  RandomEngine engine = MakeRandomEngine(5, 0);
  Table table;
  std::map<std::uint32_t, int> expected;
  std::vector<Snapshot> snapshots;
  std::vector<std::map<std::uint32_t, int>> copies;
  for (int step = 0; step < 2000; ++step) {
    const std::uint32_t action = UniformIndex(engine, 10);
    const LandmarkId id(UniformIndex(engine, 1 + step / 4));
    if (action < 3) {
      expected[Insert(table, step).value] = step;
    } else if (action < 8 && table.Find(id) != nullptr) {
      expected[id.value] = table.Edit(id).value = -step;
    } else if (action == 8 && table.Find(id) != nullptr) {
      table.Erase(id);
      expected.erase(id.value);
    } else if (action == 9) {
      snapshots.push_back(table.Snapshot());
      copies.push_back(expected);
    }
    ASSERT_EQ(table.size(), expected.size());
  }
  EXPECT_EQ(Contents(table), expected);
  ASSERT_GT(snapshots.size(), 50U);
  for (std::size_t i = 0; i < snapshots.size(); ++i) EXPECT_EQ(Contents(snapshots[i]), copies[i]);
}

TEST(VersionedTable, ATableThatGoesOnDoesNotChangeWhatItGoesOnFrom) {
  Table first;
  for (int i = 0; i < 3; ++i) {
    first.Edit(Insert(first, i)).value += 10;
    first.Snapshot();
  }
  const Snapshot snapshot = first.Snapshot();
  Table second(snapshot);
  for (int i = 0; i < 5; ++i) {
    second.Edit(LandmarkId(0)).value = 99;
    second.Snapshot();
  }
  second.Edit(LandmarkId(1)).value = 98;
  EXPECT_EQ(Contents(snapshot), (std::map<std::uint32_t, int>{{0, 10}, {1, 11}, {2, 12}}));
  EXPECT_EQ(Contents(second), (std::map<std::uint32_t, int>{{0, 99}, {1, 98}, {2, 12}}));
  EXPECT_EQ(Insert(second, 5), LandmarkId(3));
}

/// Counts the objects that exist.
struct Counted {
  LandmarkId id;
  std::shared_ptr<int> token;
};

TEST(VersionedTable, LetsGoOfWhatIsGoneInTableAndSnapshots) {
  const auto token = std::make_shared<int>();
  VersionedTable<LandmarkId, Counted> table;
  for (int i = 0; i < 100; ++i) table.Insert({{}, token});
  TableSnapshot<LandmarkId, Counted> snapshot = table.Snapshot();
  for (std::uint32_t i = 0; i < 99; ++i) table.Erase(LandmarkId(i));
  EXPECT_EQ(token.use_count(), 1 + 100) << "the snapshot's";
  snapshot = table.Snapshot();
  EXPECT_EQ(token.use_count(), 1 + 1);
  EXPECT_EQ(snapshot.ids_issued(), 100U);
  EXPECT_EQ(snapshot.Find(LandmarkId(98)), nullptr);
  EXPECT_NE(snapshot.Find(LandmarkId(99)), nullptr);
  EXPECT_EQ(table.Insert({{}, token}), LandmarkId(100));
}

TEST(VersionedTable, GoesOnInAChunkOfWhichAllIsGone) {
  Table table;
  for (int i = 0; i < 3; ++i) table.Erase(Insert(table, i));
  const Snapshot snapshot = table.Snapshot();
  EXPECT_EQ(Insert(table, 7), LandmarkId(3));
  EXPECT_EQ(Contents(table), (std::map<std::uint32_t, int>{{3, 7}}));
  EXPECT_EQ(Contents(snapshot), (std::map<std::uint32_t, int>()));
}

}  // namespace
}  // namespace ofm
