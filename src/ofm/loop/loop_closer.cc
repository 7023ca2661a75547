#include "ofm/loop/loop_closer.h"

#include <algorithm>
#include <utility>

#include "ofm/loop/submap_join.h"

namespace ofm {
namespace {

BagOfWords WordsOf(const Keyframe& keyframe) {
  return keyframe.words ? *keyframe.words : BagOfWords();
}

}  // namespace

LoopCloser::LoopCloser(const MeasurementModel& model, const LoopOptions& options,
                       std::uint64_t seed, SubmapId fixed_world)
    : model_(model),
      options_(options),
      seed_(seed),
      fixed_world_(fixed_world),
      detector_(options),
      keyframes_since_loop_(options.pause_keyframes) {}

std::optional<LoopClosure> LoopCloser::Process(const MapSnapshot& map, KeyframeId id) {
  const Keyframe* keyframe = map.keyframes.Find(id);
  if (keyframe == nullptr) return {};
  LearnLoadedMap(map, id);
  const BagOfWords words = WordsOf(*keyframe);
  if (keyframes_since_loop_ < options_.pause_keyframes) {
    ++keyframes_since_loop_;
    detector_.Add(id, words);
    return {};
  }
  ++counts_.keyframes;
  const LoopCandidates candidates = detector_.Detect(map, id, words);
  counts_.similar += candidates.similar;
  counts_.inconsistent += candidates.similar - candidates.consistent.size();
  std::optional<VerifiedLoop> loop = Verify(map, id, candidates.consistent);
  if (!loop) return {};
  auto correction = Correct(map, *loop);
  if (!correction) return {};
  closed_.push_back({loop->keyframe, loop->place});
  ++(correction->join ? counts_.joined : counts_.closed);
  keyframes_since_loop_ = 0;
  return LoopClosure{std::move(*loop), std::move(*correction)};
}

/// Empty where the solver failed.
std::optional<MapCorrection> LoopCloser::Correct(const MapSnapshot& map, const VerifiedLoop& loop) {
  const SubmapId here = map.FindSubmap(loop.keyframe), there = map.FindSubmap(loop.place);
  if (here == there) return ComputeLoopCorrection(map, loop, closed_, model_, options_);
  SubmapJoin join{std::max(here, there), std::min(here, there)};
  if (join.from == fixed_world_) std::swap(join.from, join.into);
  return ComputeSubmapJoin(map, loop, join, model_, options_);
}

/// Keyframes that were in the map before the first one that is processed.
void LoopCloser::LearnLoadedMap(const MapSnapshot& map, KeyframeId first) {
  if (std::exchange(knows_loaded_map_, true)) return;
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    if (keyframe.id < first) detector_.Add(keyframe.id, WordsOf(keyframe));
  });
}

/// The first candidate that geometry agrees with.
std::optional<VerifiedLoop> LoopCloser::Verify(const MapSnapshot& map, KeyframeId id,
                                               const std::vector<KeyframeId>& candidates) {
  constexpr std::uint64_t kStream = std::uint64_t{1} << 32;  // others use frame ids alone
  RandomEngine engine = MakeRandomEngine(seed_, kStream + id.value);
  for (const KeyframeId candidate : candidates) {
    LoopVerification verification = VerifyLoop(map, id, candidate, model_, options_, engine);
    switch (verification.verdict) {
      case LoopVerdict::kFewMatches:
        ++counts_.few_matches;
        break;
      case LoopVerdict::kNoAlignment:
        ++counts_.no_alignment;
        break;
      case LoopVerdict::kFewInliers:
        ++counts_.few_inliers;
        break;
      case LoopVerdict::kVerified:
        return std::move(verification.loop);
    }
  }
  return {};
}

}  // namespace ofm
