// Random sequences of all operations: the map must never contradict itself.
#include <gtest/gtest.h>

#include "ofm/io/test_folder.h"
#include "ofm/map/map.h"
#include "ofm/map/map_file.h"
#include "ofm/map/test_map.h"

namespace ofm {
namespace {

using test::FindProblem;

constexpr int kFeatures = 12;

/// Does random things to a map, all that a caller may do.
class RandomEditor {
 public:
  explicit RandomEditor(std::uint64_t seed) : engine_(MakeRandomEngine(seed, 0)) { AddKeyframe(); }

  /// The name of what was done.
  const char* Step() {
    using Action = void (RandomEditor::*)();
    static constexpr std::pair<const char*, Action> kActions[] = {
        {"AddKeyframe", &RandomEditor::AddKeyframe},
        {"AddLandmark", &RandomEditor::AddLandmark},
        {"AddLandmark", &RandomEditor::AddLandmark},
        {"AddLandmark", &RandomEditor::AddLandmark},
        {"AddObservation", &RandomEditor::AddObservation},
        {"AddObservation", &RandomEditor::AddObservation},
        {"RemoveObservation", &RandomEditor::RemoveObservation},
        {"Fuse", &RandomEditor::Fuse},
        {"RemoveLandmark", &RandomEditor::RemoveLandmark},
        {"RemoveKeyframe", &RandomEditor::RemoveKeyframe},
        {"Move", &RandomEditor::Move}};
    const auto& [name, action] = kActions[UniformIndex(engine_, std::size(kActions))];
    (this->*action)();
    return name;
  }

  Map& map() { return map_; }
  std::uint32_t landmarks_made() const { return landmarks_made_; }

 private:
  /// Any live keyframe.
  KeyframeId AnyKeyframe() {
    std::vector<KeyframeId> ids;
    map_.keyframes().ForEach([&](const Keyframe& k) { ids.push_back(k.id); });
    return ids[UniformIndex(engine_, static_cast<std::uint32_t>(ids.size()))];
  }
  /// A live landmark; invalid where there is none.
  LandmarkId AnyLandmark() {
    std::vector<LandmarkId> ids;
    map_.landmarks().ForEach([&](const Landmark& l) { ids.push_back(l.id); });
    if (ids.empty()) return {};
    return ids[UniformIndex(engine_, static_cast<std::uint32_t>(ids.size()))];
  }
  /// A feature of the keyframe that shows nothing; -1 where the first one tried does.
  int AnyFreeFeature(KeyframeId keyframe) {
    const int feature = static_cast<int>(UniformIndex(engine_, kFeatures));
    return map_.GetKeyframe(keyframe).landmarks[feature].valid() ? -1 : feature;
  }

  void AddKeyframe() {
    Keyframe keyframe = test::MakePlainKeyframe(kFeatures);
    for (LandmarkId& id : keyframe.landmarks) {  // live ones, fused ones, gone ones, none
      if (UniformIndex(engine_, 2)) id = LandmarkId(UniformIndex(engine_, landmarks_made_ + 2));
    }
    map_.AddKeyframe(std::move(keyframe));
  }
  void AddLandmark() {
    const KeyframeId keyframe = AnyKeyframe();
    const int feature = AnyFreeFeature(keyframe);
    if (feature < 0) return;
    map_.AddLandmark({UniformReal(engine_), UniformReal(engine_), 2}, keyframe, feature);
    ++landmarks_made_;
  }
  void AddObservation() {
    const LandmarkId landmark = AnyLandmark();
    const KeyframeId keyframe = AnyKeyframe();
    const int feature = AnyFreeFeature(keyframe);
    if (!landmark.valid() || feature < 0) return;
    if (map_.GetLandmark(landmark).FeatureIn(keyframe) >= 0) return;
    map_.AddObservation(landmark, keyframe, feature);
    map_.RefreshLandmark(landmark);
  }
  void RemoveObservation() {
    const LandmarkId landmark = AnyLandmark();
    if (!landmark.valid()) return;
    const auto& observations = map_.GetLandmark(landmark).observations;
    const auto which = UniformIndex(engine_, static_cast<std::uint32_t>(observations.size()));
    map_.RemoveObservation(landmark, observations[which].keyframe);
  }
  void Fuse() {
    const LandmarkId from = AnyLandmark(), into = AnyLandmark();
    if (from.valid() && from != into) map_.Fuse(from, into);
  }
  void RemoveLandmark() {
    const LandmarkId landmark = AnyLandmark();
    if (landmark.valid()) map_.RemoveLandmark(landmark);
  }
  void RemoveKeyframe() {
    const KeyframeId keyframe = AnyKeyframe(), anchor = AnyKeyframe();
    if (keyframe != anchor) map_.RemoveKeyframe(keyframe, anchor);
  }
  void Move() {
    map_.SetKeyframePose(AnyKeyframe(), test::CameraAt(UniformReal(engine_), 0, 0));
    const LandmarkId landmark = AnyLandmark();
    if (landmark.valid()) map_.SetLandmarkPosition(landmark, {0, UniformReal(engine_), 3});
  }

  RandomEngine engine_;
  Map map_{test::TestScales()};
  std::uint32_t landmarks_made_ = 0;
};

class MapConsistency : public testing::TestWithParam<int> {};

TEST_P(MapConsistency, HoldsAfterEveryOperation) {
  RandomEditor editor(GetParam());
  for (int step = 0; step < 400; ++step) {
    const char* done = editor.Step();
    ASSERT_EQ(FindProblem(editor.map()), "") << "after step " << step << ", " << done;
  }
  EXPECT_GT(editor.map().landmarks().size(), 0U);
}

TEST_P(MapConsistency, HoldsInEverySnapshotForEver) {
  RandomEditor editor(GetParam());
  std::vector<std::shared_ptr<const MapSnapshot>> snapshots;
  for (int step = 0; step < 400; ++step) {
    editor.Step();
    if (step % 20 == 0) snapshots.push_back(editor.map().Snapshot());
  }
  for (const auto& snapshot : snapshots) ASSERT_EQ(FindProblem(*snapshot), "");
}

TEST_P(MapConsistency, EveryNameEverGivenLeadsToALiveLandmarkOrNone) {
  RandomEditor editor(GetParam());
  for (int step = 0; step < 400; ++step) editor.Step();
  const auto snapshot = editor.map().Snapshot();
  ASSERT_EQ(snapshot->replacements.size(), editor.landmarks_made());
  for (std::uint32_t i = 0; i < editor.landmarks_made(); ++i) {
    const Landmark* landmark = editor.map().FindLandmark(LandmarkId(i));
    EXPECT_EQ(snapshot->FindLandmark(LandmarkId(i)), landmark);
    if (landmark == nullptr) continue;
    EXPECT_EQ(editor.map().landmarks().Find(landmark->id), landmark);
  }
  for (const auto& [id, anchor] : snapshot->anchors) {
    EXPECT_EQ(snapshot->keyframes.Find(id), nullptr);
    EXPECT_TRUE(snapshot->FindKeyframePose(id).has_value());
  }
}

TEST_P(MapConsistency, ComesBackFromAFileAndGoesOn) {
  const TestFolder folder;
  RandomEditor editor(GetParam());
  for (int step = 0; step < 200; ++step) editor.Step();
  const auto saved = editor.map().Snapshot();
  SaveMap(folder.path() / "m.ofm", *saved, {});
  const StoredMap stored = LoadMap(folder.path() / "m.ofm");
  ASSERT_EQ(test::FindDifference(*stored.map, *saved), "");
  editor.map() = Map(test::TestScales(), *stored.map);
  for (int step = 0; step < 200; ++step) {
    const char* done = editor.Step();
    ASSERT_EQ(FindProblem(editor.map()), "") << "after step " << step << ", " << done;
  }
  EXPECT_EQ(test::FindDifference(*stored.map, *saved), "") << "the loaded one has not changed";
}

INSTANTIATE_TEST_SUITE_P(Seeds, MapConsistency, testing::Range(0, 8));

}  // namespace
}  // namespace ofm
