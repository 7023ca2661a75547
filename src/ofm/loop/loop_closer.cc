#include "ofm/loop/loop_closer.h"

#include <utility>

#include "ofm/loop/static_landmarks.h"

namespace ofm {

LoopCloser::LoopCloser(const MeasurementModel& model, const LoopOptions& options,
                       const Vocabulary& vocabulary, std::uint64_t seed)
    : model_(model),
      options_(options),
      vocabulary_(vocabulary),
      seed_(seed),
      detector_(options),
      keyframes_since_loop_(options.pause_keyframes) {}

std::optional<LoopClosure> LoopCloser::Process(const MapSnapshot& map, KeyframeId id) {
  const Keyframe* keyframe = map.keyframes.Find(id);
  if (keyframe == nullptr) return {};
  LearnLoadedMap(map, id);
  const BagOfWords words = Describe(map, *keyframe);
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
  auto correction = ComputeLoopCorrection(map, *loop, closed_, model_, options_);
  if (!correction) return {};
  closed_.push_back({loop->keyframe, loop->place});
  ++counts_.closed;
  keyframes_since_loop_ = 0;
  return LoopClosure{std::move(*loop), std::move(*correction)};
}

/// The words of what stands still.
BagOfWords LoopCloser::Describe(const MapSnapshot& map, const Keyframe& keyframe) const {
  return vocabulary_.Describe(StaticDescriptors(map, keyframe, options_.min_static_probability))
      .words;
}

/// Keyframes that were in the map before the first one that is processed.
void LoopCloser::LearnLoadedMap(const MapSnapshot& map, KeyframeId first) {
  if (std::exchange(knows_loaded_map_, true)) return;
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    if (keyframe.id < first) detector_.Add(keyframe.id, Describe(map, keyframe));
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
