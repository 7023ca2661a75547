// Recall and precision of place queries on real sequences, and their times. With the built-in
// vocabulary and those given as files:
//   build/release/bin/place_benchmark [--benchmark_...] [VOCABULARY...]
// What counts as right is in place_quality.h.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/base/timing.h"
#include "ofm/features/default_vocabulary.h"
#include "ofm/features/node_matching.h"
#include "ofm/features/place_database.h"
#include "ofm/features/vocabulary_file.h"
#include "place_quality.h"

namespace ofm {
namespace {

constexpr int kFrameStep = 2;
constexpr const char* kSequences[] = {"tum_fr1_desk", "tum_fr1_xyz_240"};

struct NamedVocabulary {
  std::string name;
  Vocabulary vocabulary;
};

std::vector<PlaceView> ReadSequence(const std::string& name, int step) {
  const RgbdSampleSource source(OFM_SHARED_DIR "/data/" + name, *FindCameraPreset("tum-fr1"));
  if (!source.is_real()) fmt::print("{} is absent: a synthetic wall instead\n", name);
  return ReadViews(source, step);
}

const std::vector<PlaceView>& Desk() {
  static const std::vector<PlaceView> views = ReadSequence(kSequences[0], kFrameStep);
  return views;
}

/// 100,000 words of random bits.
Vocabulary LargeVocabulary() {
  RandomEngine engine = MakeRandomEngine(1, 0);
  VocabularyTree tree;
  std::size_t nodes = 0, level = 1;
  for (int depth = 0; depth <= 5; ++depth, level *= 10) {
    nodes += level;
    tree.child_counts.resize(nodes, depth < 5 ? 10 : 0);
  }
  tree.descriptors.resize(nodes);
  for (Descriptor& descriptor : tree.descriptors) {
    for (std::uint64_t& word : descriptor) word = engine();
  }
  tree.idf.assign(100'000, 1);
  return Vocabulary(std::move(tree));
}

void BM_Load100kWords(benchmark::State& state) {
  const auto path = std::filesystem::temp_directory_path() / "ofm_place_benchmark.voc";
  SaveVocabulary(path, LargeVocabulary());
  for (auto _ : state) benchmark::DoNotOptimize(LoadVocabulary(path));
  state.counters["MB"] = static_cast<double>(std::filesystem::file_size(path)) * 1e-6;
  std::filesystem::remove(path);
}
BENCHMARK(BM_Load100kWords)->Unit(benchmark::kMillisecond);

void BM_DecodeDefault(benchmark::State& state) {
  const std::string bytes = EncodeVocabulary(DefaultVocabulary());
  for (auto _ : state) benchmark::DoNotOptimize(DecodeVocabulary(bytes, "default"));
}
BENCHMARK(BM_DecodeDefault)->Unit(benchmark::kMillisecond);

void BM_Describe(benchmark::State& state) {
  const std::vector<PlaceView>& views = Desk();
  std::size_t i = 0;
  for (auto _ : state) {
    const PlaceView& view = views[i++ % views.size()];
    benchmark::DoNotOptimize(DefaultVocabulary().Describe(view.features.descriptors));
  }
}
BENCHMARK(BM_Describe)->Unit(benchmark::kMicrosecond);

void BM_QueryAmongDesk(benchmark::State& state) {
  PlaceDatabase database;
  std::vector<BagOfWords> words;
  for (std::uint32_t i = 0; i < Desk().size(); ++i) {
    words.push_back(DefaultVocabulary().Describe(Desk()[i].features.descriptors).words);
    database.Add(KeyframeId(i), words.back());
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(database.Query(words[i++ % words.size()]));
  state.counters["key frames"] = static_cast<double>(database.size());
}
BENCHMARK(BM_QueryAmongDesk)->Unit(benchmark::kMicrosecond);

/// "0.43 (from 0.181)": recall, and the similarity from which answers count.
std::string WithThreshold(double recall, double threshold) {
  return fmt::format("{:.3f} (from {:.3f})", recall, threshold);
}

void PrintQuality(const std::vector<NamedVocabulary>& vocabularies) {
  for (const char* sequence : kSequences) {
    const std::vector<PlaceView> views = ReadSequence(sequence, kFrameStep);
    const auto overlaps = ViewOverlaps(*FindCameraPreset("tum-fr1"), views);
    fmt::print("\n{}, {} views\n{:24} {:>11} {:>8} {:>11} {:>20} {:>20}\n", sequence, views.size(),
               "vocabulary", "wrong under", "expected", "first right", "recall at P = 1",
               "at P = 0.95");
    for (const NamedVocabulary& v : vocabularies) {
      for (const double overlap_wrong : {0.25, 0.1}) {
        const PlaceQuality q =
            MeasurePlaces(v.vocabulary, views, overlaps, {.overlap_wrong = overlap_wrong});
        fmt::print("{:24} {:11.2f} {:8} {:11.3f} {:>20} {:>20}\n", v.name, overlap_wrong,
                   q.expected, static_cast<double>(q.first_right) / std::max(q.expected, 1),
                   WithThreshold(q.recall_at_full_precision, q.threshold_at_full_precision),
                   WithThreshold(q.recall_at_95_precision, q.threshold_at_95_precision));
      }
    }
  }
}

/// Matches within nodes beside brute force, on views half a second apart.
void PrintMatching(const std::vector<NamedVocabulary>& vocabularies) {
  constexpr std::size_t kGap = 8;
  const auto measure = [](const char* name, auto&& match) {
    std::size_t matches = 0, pairs = 0;
    const std::int64_t start_ns = ThreadCpuTimeNs();
    for (std::size_t i = 0; i + kGap < Desk().size(); i += 4, ++pairs)
      matches += match(i, i + kGap);
    const double ms = static_cast<double>(ThreadCpuTimeNs() - start_ns) * 1e-6;
    fmt::print("{:40} {:12.1f} {:10.2f}\n", name,
               static_cast<double>(matches) / static_cast<double>(pairs),
               ms / static_cast<double>(pairs));
  };
  fmt::print("\n{:40} {:>12} {:>10}\n", "matching, 0.5 s apart", "matches", "ms a pair");
  const std::vector<PlaceView>& views = Desk();  // read before the first clock starts
  const auto descriptors = [&](std::size_t i) { return views[i].features.descriptors; };
  measure("brute force", [&](std::size_t i, std::size_t j) {
    return MatchBruteForce(descriptors(i), descriptors(j)).size();
  });
  for (const NamedVocabulary& v : vocabularies) {
    for (const int depth : {1, 2, 3}) {
      std::vector<std::vector<std::uint32_t>> nodes;
      for (const PlaceView& view : Desk()) {
        nodes.push_back(v.vocabulary.Describe(view.features.descriptors, depth).nodes);
      }
      const std::string name = fmt::format("{}, nodes of level {}", v.name, depth);
      measure(name.c_str(), [&](std::size_t i, std::size_t j) {
        return MatchByNode({descriptors(i), nodes[i]}, {descriptors(j), nodes[j]}).size();
      });
    }
  }
}

}  // namespace
}  // namespace ofm

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  std::vector<ofm::NamedVocabulary> vocabularies = {{"built in", ofm::DefaultVocabulary()}};
  for (int i = 1; i < argc; ++i) {
    vocabularies.push_back(
        {std::filesystem::path(argv[i]).filename().string(), ofm::LoadVocabulary(argv[i])});
  }
  benchmark::RunSpecifiedBenchmarks();
  ofm::PrintQuality(vocabularies);
  ofm::PrintMatching(vocabularies);
  return 0;
}
