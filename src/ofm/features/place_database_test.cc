#include "ofm/features/place_database.h"

#include <gmock/gmock.h>

#include "ofm/base/random.h"

namespace ofm {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

BagOfWords RandomBag(std::uint64_t seed) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  std::vector<WeightedWord> words;
  for (int i = 0; i < 30; ++i) {
    words.push_back({UniformIndex(engine, 200), static_cast<float>(UniformReal(engine))});
  }
  return MakeBagOfWords(words);
}

PlaceDatabase RandomDatabase(std::uint32_t size) {
  PlaceDatabase database;
  for (std::uint32_t id = 0; id < size; ++id) database.Add(KeyframeId(id), RandomBag(id + 1));
  return database;
}

SimilarPlace Place(std::uint32_t id, double similarity) { return {KeyframeId(id), similarity}; }

TEST(PlaceDatabase, FindsWhatSimilarityFindsOneByOne) {
  const PlaceDatabase database = RandomDatabase(50);
  const BagOfWords query = RandomBag(1000);
  const std::vector<SimilarPlace> found = database.Query(query);
  std::size_t similar = 0;
  for (std::uint32_t id = 0; id < 50; ++id) similar += Similarity(query, RandomBag(id + 1)) > 0;
  ASSERT_EQ(found.size(), similar);
  ASSERT_GT(similar, 20U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].similarity, Similarity(query, RandomBag(found[i].keyframe.value + 1)));
    EXPECT_GE(found[i == 0 ? 0 : i - 1].similarity, found[i].similarity);
  }
}

TEST(PlaceDatabase, FindsTheSamePlaceFirst) {
  const PlaceDatabase database = RandomDatabase(50);
  EXPECT_EQ(database.Query(RandomBag(31))[0].keyframe, KeyframeId(30));
}

TEST(PlaceDatabase, OrdersEquallySimilarPlacesById) {
  PlaceDatabase database;
  const BagOfWords words = {{3, 0.5F}, {5, 0.5F}};
  for (const std::uint32_t id : {7U, 2U, 5U}) database.Add(KeyframeId(id), words);
  EXPECT_THAT(database.Query(words), ElementsAre(Place(2, 1), Place(5, 1), Place(7, 1)));
}

TEST(PlaceDatabase, LeavesOutWhatTheQueryDoesNotWant) {
  PlaceDatabase database;
  database.Add(KeyframeId(0), {{1, 1}});
  database.Add(KeyframeId(1), {{1, 0.5F}, {2, 0.5F}});
  database.Add(KeyframeId(2), {{1, 0.25F}, {3, 0.75F}});
  database.Add(KeyframeId(3), {{4, 1}});
  const BagOfWords query = {{1, 1}};
  EXPECT_THAT(database.Query(query), ElementsAre(Place(0, 1), Place(1, 0.5), Place(2, 0.25)));
  EXPECT_THAT(database.Query(query, {.min_similarity = 0.5}),
              ElementsAre(Place(0, 1), Place(1, 0.5)));
  EXPECT_THAT(database.Query(query, {.max_count = 1}), ElementsAre(Place(0, 1)));
  EXPECT_THAT(database.Query(query, {.max_count = 1, .excluded = {KeyframeId(0)}}),
              ElementsAre(Place(1, 0.5)));
}

TEST(PlaceDatabase, ForgetsWhatIsRemoved) {
  PlaceDatabase database = RandomDatabase(10);
  database.Remove(KeyframeId(4));
  database.Remove(KeyframeId(4));
  database.Remove(KeyframeId(99));
  EXPECT_EQ(database.size(), 9U);
  EXPECT_EQ(database.Find(KeyframeId(4)), nullptr);
  for (const SimilarPlace& place : database.Query(RandomBag(5))) {
    EXPECT_NE(place.keyframe, KeyframeId(4));
  }
  database.Remove(KeyframeId(9));  // the one with the largest id
  EXPECT_EQ(database.Query(RandomBag(1))[0].keyframe, KeyframeId(0));
}

TEST(PlaceDatabase, ReplacesWhatIsAddedAgain) {
  PlaceDatabase database;
  database.Add(KeyframeId(1), {{1, 1}});
  database.Add(KeyframeId(1), {{2, 1}});
  EXPECT_EQ(database.size(), 1U);
  EXPECT_THAT(database.Query({{1, 1}}), IsEmpty());
  EXPECT_THAT(database.Query({{2, 1}}), ElementsAre(Place(1, 1)));
  EXPECT_THAT(*database.Find(KeyframeId(1)), ElementsAre(WeightedWord{2, 1}));
}

TEST(PlaceDatabase, CopiesAreIndependent) {
  const PlaceDatabase original = RandomDatabase(10);
  PlaceDatabase copy = original;
  copy.Remove(KeyframeId(3));
  copy.Add(KeyframeId(10), RandomBag(11));
  EXPECT_EQ(original.size(), 10U);
  EXPECT_EQ(original.Query(RandomBag(4))[0].keyframe, KeyframeId(3));
  EXPECT_EQ(copy.Query(RandomBag(11))[0].keyframe, KeyframeId(10));
}

TEST(PlaceDatabase, FindsNothingWhereThereIsNothing) {
  EXPECT_THAT(PlaceDatabase().Query(RandomBag(1)), IsEmpty());
  EXPECT_THAT(RandomDatabase(5).Query({}), IsEmpty());
  PlaceDatabase blank;
  blank.Add(KeyframeId(0), {});
  EXPECT_THAT(blank.Query(RandomBag(1)), IsEmpty());
  EXPECT_THROW(blank.Add(KeyframeId(), {}), std::logic_error);
}

}  // namespace
}  // namespace ofm
