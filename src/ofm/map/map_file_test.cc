#include "ofm/map/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "ofm/features/default_vocabulary.h"
#include "ofm/features/static_words.h"
#include "ofm/features/test_vocabulary.h"
#include "ofm/io/read_file.h"
#include "ofm/io/sha256.h"
#include "ofm/io/sqlite_database.h"
#include "ofm/io/test_folder.h"
#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using testing::HasSubstr;

/// A map with (at least 5) features of random numbers, a removed keyframe, a fused and a removed
/// landmark.
std::shared_ptr<const MapSnapshot> MakeMap(int features = 10) {
  RandomEngine engine = MakeRandomEngine(1, 2);
  Map map(test::TestScales());
  for (std::uint32_t k = 0; k < 4; ++k) {
    auto made = std::make_shared<FrameFeatures>();
    for (int i = 0; i < features; ++i) {
      const auto real = [&] { return static_cast<float>(600 * UniformReal(engine)); };
      made->keypoints.push_back({{real(), real()}, i % 8, real(), real()});
      made->descriptors.push_back(test::RandomDescriptor(engine));
      made->ideal_px.emplace_back(real(), real());
      made->depth_m.push_back(i % 3 == 0 ? 0 : real());
      if (k != 1) made->static_probability.push_back(real() / 600);
    }
    made->grid = FeatureGrid(made->ideal_px, 640, 480);
    Keyframe keyframe = test::MakeTestKeyframe(
        made, {ExpSo3({0.1 * k, UniformReal(engine), 0.2}), {UniformReal(engine), 0, -0.1}});
    keyframe.stamp_ns = 1305031453359684000 + k;
    map.AddKeyframe(keyframe);
  }
  for (int i = 0; i < features - 1; ++i) {
    const LandmarkId id = map.AddLandmark({UniformReal(engine), 0.1, 3}, KeyframeId(0), i);
    for (std::uint32_t k = 1; k < 4; ++k) map.AddObservation(id, KeyframeId(k), (i + 1) % features);
    map.CountSightings(id, i, 2 * i);
    map.UpdateStaticProbability(id, 0.25F);
  }
  map.Fuse(LandmarkId(1), LandmarkId(2));
  map.RemoveLandmark(LandmarkId(3));
  map.RemoveKeyframe(KeyframeId(2), KeyframeId(1));
  return map.Snapshot();
}

class MapFile : public testing::Test {
 protected:
  MapFile() : path_(folder_.path() / "m.ofm") {}

  /// What LoadMap says of these bytes.
  std::string ErrorOfBytes(std::string_view bytes) const {
    return ErrorOf([&] { LoadMap(folder_.Write("changed.ofm", bytes)); });
  }
  /// The file with its database changed by `sql` and a right checksum.
  std::string Changed(const std::string& sql) const {
    const std::string bytes = ReadFile(path_);
    SqliteDatabase database(std::string_view(bytes).substr(0, bytes.rfind("\nofm-map sha256 ")));
    database.Execute(sql);
    return Seal(database.Serialize());
  }
  static std::string Seal(const std::string& contents) {
    Sha256 hash;
    hash.Add(contents);
    return contents + "\nofm-map sha256 " + hash.Finish() + "\n";
  }

  TestFolder folder_;
  const std::filesystem::path path_;
};

TEST_F(MapFile, GivesBackTheMapToTheLastBit) {
  const auto map = MakeMap();
  SaveMap(path_, *map, {});
  const StoredMap stored = LoadMap(path_);
  EXPECT_EQ(test::FindDifference(*stored.map, *map), "");
  EXPECT_EQ(test::FindProblem(*stored.map), "");
  const Keyframe& keyframe = *stored.map->keyframes.Find(KeyframeId(0));
  EXPECT_FALSE(keyframe.frame_id.valid());
  EXPECT_EQ(*keyframe.words, StaticWords(*keyframe.features, DefaultVocabulary()));
  EXPECT_EQ(stored.map->FindLandmark(LandmarkId(1))->id, LandmarkId(2));
}

TEST_F(MapFile, WordsAreOfTheVocabularyThatIsAskedFor) {
  SaveMap(path_, *MakeMap(), {});
  const auto vocabulary = std::make_shared<const Vocabulary>(RegularTree(9));
  const StoredMap stored = LoadMap(path_, vocabulary);
  EXPECT_EQ(stored.map->vocabulary, vocabulary);
  const Keyframe& keyframe = *stored.map->keyframes.Find(KeyframeId(0));
  EXPECT_FALSE(keyframe.words->empty());
  EXPECT_EQ(*keyframe.words, StaticWords(*keyframe.features, *vocabulary));
  EXPECT_NE(*keyframe.words, StaticWords(*keyframe.features, DefaultVocabulary()));
}

TEST_F(MapFile, GivesBackTheSettings) {
  MapSettings settings;
  settings.camera = *FindCameraPreset("tum-fr1");
  settings.levels = 9;
  settings.scale_factor = 1.3;
  SaveMap(path_, *MakeMap(), settings);
  EXPECT_EQ(ErrorOf([&] { RequireSameSettings(path_, LoadMap(path_).settings, settings); }), "");
}

TEST_F(MapFile, SameMapGivesTheSameBytesAlsoAfterALoad) {
  const auto again = folder_.path() / "again.ofm", loaded = folder_.path() / "loaded.ofm";
  SaveMap(path_, *MakeMap(), {});
  SaveMap(again, *MakeMap(), {});
  const StoredMap stored = LoadMap(path_);
  SaveMap(loaded, *stored.map, stored.settings);
  EXPECT_TRUE(ReadFile(again) == ReadFile(path_));
  EXPECT_TRUE(ReadFile(loaded) == ReadFile(path_));
}

TEST_F(MapFile, FeaturesAreFoundAsBefore) {
  const auto map = MakeMap();
  SaveMap(path_, *map, {});
  const auto find = [](const MapSnapshot& in) {
    std::vector<int> found;
    in.keyframes.Find(KeyframeId(1))->features->grid.VisitNear({300, 200}, 150, [&](int feature) {
      found.push_back(feature);
    });
    return found;
  };
  EXPECT_EQ(find(*LoadMap(path_).map), find(*map));
}

TEST_F(MapFile, AnyFlippedBitIsFound) {
  SaveMap(path_, *MakeMap(5), {});
  const std::string bytes = ReadFile(path_);
  for (std::size_t i = 0; i < bytes.size(); i += i < 96 || i > bytes.size() - 96 ? 4 : 1499) {
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
    ASSERT_THAT(ErrorOfBytes(flipped), testing::ContainsRegex("damaged|changed")) << i;
  }
}

TEST_F(MapFile, ACutFileIsFound) {
  SaveMap(path_, *MakeMap(5), {});
  const std::string bytes = ReadFile(path_);
  for (const std::size_t size : {std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_THAT(ErrorOfBytes(bytes.substr(0, size)), HasSubstr("changed.ofm: is cut short"));
  }
  EXPECT_THAT(ErrorOfBytes(bytes + "x"), HasSubstr("changed.ofm: is cut short or was changed"));
}

TEST_F(MapFile, SomethingElseIsNoMap) {
  EXPECT_THAT(ErrorOf([&] { LoadMap(path_); }), HasSubstr("m.ofm: does not exist"));
  EXPECT_THAT(ErrorOf([&] { LoadMap(folder_.path()); }), HasSubstr("is a folder"));
  SqliteDatabase other;
  other.Execute("CREATE TABLE things (id INTEGER PRIMARY KEY)");
  for (const std::string& bytes : {std::string(), std::string("# a trajectory\n"),
                                   other.Serialize(), std::string(5000, 'x')}) {
    EXPECT_THAT(ErrorOfBytes(bytes), HasSubstr("changed.ofm: is no map of ofm-slam"));
  }
}

TEST_F(MapFile, SubmapsStayApart) {
  Map map(test::TestScales(), *MakeMap());
  Keyframe apart = test::MakePlainKeyframe(5);
  apart.submap = SubmapId();
  map.AddKeyframe(apart);
  SaveMap(path_, *map.Snapshot(), {});
  const StoredMap stored = LoadMap(path_);
  EXPECT_EQ(test::FindDifference(*stored.map, *map.Snapshot()), "");
  EXPECT_EQ(stored.map->FindSubmap(KeyframeId(3)), SubmapId(0));
  EXPECT_EQ(stored.map->FindSubmap(KeyframeId(4)), SubmapId(4));
}

TEST_F(MapFile, AnotherVersionIsNamed) {
  SaveMap(path_, *MakeMap(), {});
  std::string bytes = ReadFile(path_);
  bytes[63] = 3;  // the last byte of SQLite's user_version
  EXPECT_THAT(ErrorOfBytes(Seal(bytes.substr(0, bytes.rfind("\nofm-map")))),
              HasSubstr("is a map of version 3, but this program reads version 2; make it anew"));
}

TEST_F(MapFile, TablesThatContradictThemselvesAreFound) {
  SaveMap(path_, *MakeMap(), {});
  EXPECT_EQ(ErrorOfBytes(Changed("SELECT 1")), "");
  const std::pair<const char*, const char*> cases[] = {
      {"DELETE FROM landmarks WHERE id = 0", "names a landmark that there is not"},
      {"DELETE FROM settings WHERE name = 'camera.fx'", "the setting 'camera.fx' is missing"},
      {"UPDATE keyframes SET depths_m = x'00'", "a list has 1 bytes where it needs 40"},
      {"UPDATE keyframes SET octaves = x'09090909090909090909'", "a level that there is not"},
      {"UPDATE settings SET value = '1' WHERE name = 'keyframe_ids'", "id was never issued"},
      {"DELETE FROM keyframes", "no keyframe names a landmark"},
      {"UPDATE keyframes SET submap = 3 WHERE id = 3", "a landmark is of two sub-maps"},
      {"UPDATE keyframes SET submap = 4", "a sub-map was never begun"},
      {"DROP TABLE anchors", "no such table: anchors"}};
  for (const auto& [sql, reason] : cases) {
    EXPECT_THAT(ErrorOfBytes(Changed(sql)),
                AllOf(HasSubstr("is no map that ofm-slam wrote: "), HasSubstr(reason)));
  }
}

TEST_F(MapFile, OtherSettingsAreNamed) {
  const MapSettings stored;
  MapSettings wanted;
  wanted.camera.depth_scale = 1000;
  wanted.camera.depth_delay_s = .5;
  EXPECT_EQ(ErrorOf([&] { RequireSameSettings(path_, stored, wanted); }), "");
  wanted.camera.fx = 517.3;
  EXPECT_EQ(ErrorOf([&] { RequireSameSettings(path_, stored, wanted); }),
            path_.string() +
                ": was made with camera.fx = 525, but here it is 517.3; choose the "
                "map's --camera");
  wanted = stored;
  wanted.levels = 6;
  EXPECT_THAT(ErrorOf([&] { RequireSameSettings(path_, stored, wanted); }),
              HasSubstr("features.levels = 8, but here it is 6; choose the map's value"));
}

TEST_F(MapFile, AnEmptyMapIsNotWritten) {
  EXPECT_THAT(ErrorOf([&] { SaveMap(path_, MapSnapshot(), {}); }),
              HasSubstr("m.ofm: is not written: the map has no keyframe"));
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(MapFile, AFullDiskLeavesTheOldMap) {
  SaveMap(path_, *MakeMap(5), {});
  const std::string old = ReadFile(path_);
  void (*const handler)(int) = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{20'000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  const std::string message = ErrorOf([&] { SaveMap(path_, *MakeMap(1000), {}); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, HasSubstr("m.ofm: cannot be written: File too large"));
  EXPECT_TRUE(ReadFile(path_) == old);
  EXPECT_EQ(folder_.CountEntries(), 1U);
}

TEST_F(MapFile, AFolderThatIsNotThereIsAnError) {
  EXPECT_THAT(ErrorOf([&] { SaveMap(folder_.path() / "none" / "m.ofm", *MakeMap(), {}); }),
              HasSubstr("none/m.ofm: cannot be written: No such file or directory"));
}

}  // namespace
}  // namespace ofm
