// Runs that begin with a map, and runs that lose sight of theirs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ofm/eval/ate.h"
#include "ofm/features/static_words.h"
#include "ofm/features/test_vocabulary.h"
#include "ofm/features/vocabulary_file.h"
#include "ofm/io/test_folder.h"
#include "ofm/map/map_file.h"
#include "ofm/map/test_map.h"
#include "ofm/pipeline/test_support.h"
#include "ofm/pipeline/trajectory_log.h"

namespace ofm {
namespace {

using test::PlaySource;
using test::Recording;

constexpr int kMapped = 10, kFrames = 16;

/// A recording whose first frames are mapped.
class StoredMapRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    recording_ = std::make_unique<Recording>(kFrames);
    const RunOutcome outcome = Run(nullptr, 0, kMapped);
    ASSERT_EQ(outcome.counts.frames_tracked, static_cast<std::size_t>(kMapped));
    const TestFolder folder;
    SaveMap(folder.path() / "m.ofm", *outcome.map, {recording_->sequence.camera()});
    map_ = LoadMap(folder.path() / "m.ofm").map;
  }
  static void TearDownTestSuite() {
    recording_.reset();
    map_.reset();
  }

  using Runner = RunOutcome (*)(Slam&, FrameSource&, const RunContext&);

  /// Runs over the frames from `first` on, with `map`.
  static RunOutcome Run(std::shared_ptr<const MapSnapshot> map, int first, int count,
                        const SlamOptions& options = Options(), Runner runner = &RunSequential) {
    const auto begin = recording_->images.begin() + first;
    PlaySource source({begin, begin + count});
    Slam slam(recording_->sequence.camera(), options,
              std::make_unique<test::TruthSegmenter>(recording_->sequence), std::move(map));
    return runner(slam, source, {});
  }
  static SlamOptions Options() {
    SlamOptions options = test::KeyframesOften();
    options.build_semantic_map = false;
    return options;
  }
  static SlamOptions LocalizeOnly() {
    SlamOptions options = test::KeyframesOften();
    options.localize_only = true;
    return options;
  }
  /// In the map's world: aligned by its keyframes.
  static double Ate_m(const Trajectory& estimate) {
    const Trajectory truth = recording_->sequence.GroundTruth();
    const AteResult of_map = ComputeAte(KeyframeTrajectory(*map_, SubmapId(0)), truth);
    return ComputeAte(estimate, truth, kMaxStampDifference_s, of_map.truth_from_estimate)
        .translation_m.rmse;
  }

  static std::unique_ptr<Recording> recording_;
  static std::shared_ptr<const MapSnapshot> map_;
};

std::unique_ptr<Recording> StoredMapRun::recording_;
std::shared_ptr<const MapSnapshot> StoredMapRun::map_;

TEST_F(StoredMapRun, LocaliseOnlyTracksInTheMapAndLeavesItAsItIs) {
  for (const Runner runner : {Runner{&RunSequential}, Runner{&RunThreaded}}) {
    const RunOutcome outcome = Run(map_, kMapped, kFrames - kMapped, LocalizeOnly(), runner);
    EXPECT_EQ(outcome.counts.frames_tracked, outcome.counts.frames);
    EXPECT_EQ(outcome.counts.keyframes_made, 0U);
    EXPECT_EQ(test::FindDifference(*outcome.map, *map_), "");
    EXPECT_FALSE(outcome.semantic_map);
    EXPECT_LT(Ate_m(outcome.trajectory), 0.03);
  }
}

TEST_F(StoredMapRun, FramesFromAnywhereInTheRecordingAreLocalised) {
  const RunOutcome outcome = Run(map_, 5, 6, LocalizeOnly());
  EXPECT_EQ(outcome.counts.frames_tracked, 6U);
  EXPECT_LT(Ate_m(outcome.trajectory), 0.02);
}

TEST_F(StoredMapRun, GoesOnMappingUnderNewIds) {
  const RunOutcome outcome = Run(map_, kMapped, kFrames - kMapped, test::KeyframesOften());
  EXPECT_EQ(outcome.counts.frames_tracked, outcome.counts.frames);
  EXPECT_GE(outcome.counts.keyframes_made, 2U);
  EXPECT_EQ(test::FindProblem(*outcome.map), "");
  EXPECT_EQ(outcome.map->keyframes.ids_issued(),
            map_->keyframes.ids_issued() + outcome.counts.keyframes_made);
  EXPECT_GT(outcome.map->landmarks.ids_issued(), map_->landmarks.ids_issued());
  EXPECT_LT(Ate_m(outcome.trajectory), 0.03);
  ASSERT_TRUE(outcome.semantic_map);
}

TEST_F(StoredMapRun, FramesOfTheSameNumbersAsTheMapsDoNotConfuseIt) {
  // The same frames once more, as a second visit: the newest keyframe was one of them.
  const RunOutcome outcome = Run(map_, 0, kMapped);
  EXPECT_EQ(outcome.counts.frames_tracked, static_cast<std::size_t>(kMapped));
  EXPECT_LT(Ate_m(outcome.trajectory), 0.02);
  EXPECT_LT(Ate_m(outcome.live_trajectory), 0.03);
}

TEST_F(StoredMapRun, NeverRelocalisedLeavesTheMapAsItIs) {
  SlamOptions options = Options();
  options.tracking.min_relocalization_inliers = 1000;
  const RunOutcome outcome = Run(map_, kMapped, 4, options);
  EXPECT_EQ(outcome.counts.frames_tracked, 0U);
  EXPECT_EQ(outcome.counts.losses, 1U);
  EXPECT_EQ(test::FindDifference(*outcome.map, *map_), "");
}

TEST_F(StoredMapRun, TheVocabularyOfTheOptionsMakesAllWords) {
  const TestFolder folder;
  const Vocabulary vocabulary{RegularTree(9)};
  SaveVocabulary(folder.path() / "own.voc", vocabulary);
  SlamOptions options = Options();
  options.vocabulary = (folder.path() / "own.voc").string();
  const auto words_are_its = [&](const MapSnapshot& map) {
    bool all = map.keyframe_count > 0;
    map.keyframes.ForEach([&](const Keyframe& keyframe) {
      all = all && *keyframe.words == StaticWords(*keyframe.features, vocabulary);
    });
    return all;
  };
  const auto mapped = Run(nullptr, 0, kMapped, options).map;
  EXPECT_TRUE(words_are_its(*mapped));
  EXPECT_TRUE(words_are_its(*Run(mapped, kMapped, kFrames - kMapped, options).map));
}

TEST_F(StoredMapRun, AFileThatIsNoVocabularyIsAnError) {
  const TestFolder folder;
  SlamOptions options = Options();
  options.vocabulary = folder.Write("a.voc", "words").string();
  EXPECT_THAT(ErrorOf([&] { Run(nullptr, 0, 1, options); }), testing::HasSubstr("a.voc: "));
}

TEST_F(StoredMapRun, LocaliseOnlyWithoutAMapIsAnError) {
  EXPECT_THAT(ErrorOf([] { Run(nullptr, 0, 1, LocalizeOnly()); }),
              testing::HasSubstr("localize_only needs a map"));
}

TEST_F(StoredMapRun, ACoveredCameraIsLostAndFindsItsPlaceAgain) {
  std::vector<RgbdFrame> frames = recording_->images;
  constexpr int kFirst = 6, kCovered = 4;
  for (int i = kFirst; i < kFirst + kCovered; ++i) {
    frames[i].color = cv::Mat::zeros(frames[i].color.size(), CV_8UC3);
    frames[i].gray = cv::Mat::zeros(frames[i].gray.size(), CV_8UC1);
    frames[i].depth_m = cv::Mat::zeros(frames[i].depth_m.size(), CV_32FC1);
  }
  std::vector<TrackingStatus> statuses;
  test::CallingObserver observer([&](const FrameReport& report) {
    statuses.push_back(report.tracking.status);
    const bool covered = statuses.size() > kFirst && statuses.size() <= kFirst + kCovered;
    EXPECT_FALSE(covered && report.tracking.keyframe);
  });
  RunContext context;
  context.observers = {&observer};
  PlaySource source(frames);
  const RunOutcome outcome =
      RunSequential(*test::MakeSlam(*recording_, Options()), source, context);
  for (int i = 0; i < kFrames; ++i) {
    const bool covered = i >= kFirst && i < kFirst + kCovered;
    EXPECT_EQ(statuses[i], i == kFirst              ? TrackingStatus::kReckoned
                           : covered                ? TrackingStatus::kLost
                           : i == 0                 ? TrackingStatus::kInitialized
                           : i == kFirst + kCovered ? TrackingStatus::kRelocalized
                                                    : TrackingStatus::kTracked)
        << i;
  }
  EXPECT_EQ(outcome.counts.losses, 1U);
  EXPECT_LT(ComputeAte(outcome.trajectory, recording_->sequence.GroundTruth()).translation_m.rmse,
            0.02);
}

}  // namespace
}  // namespace ofm
