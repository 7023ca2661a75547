// Time of SaveMap and LoadMap, and the size of the file, by size of the map.
#include <benchmark/benchmark.h>

#include "ofm/io/test_folder.h"
#include "ofm/map/map_file.h"
#include "ofm/map/test_map.h"

namespace ofm {
namespace {

constexpr int kFeatures = 1000, kNewLandmarks = 200;

/// A map of keyframes with 1000 features, of which 200 show new landmarks and 600 those of the
/// three keyframes before.
std::shared_ptr<const MapSnapshot> MakeMap(int keyframes) {
  RandomEngine engine = MakeRandomEngine(1, 0);
  Map map(test::TestScales());
  for (int k = 0; k < keyframes; ++k) {
    std::vector<test::TestFeature> features(kFeatures);
    for (test::TestFeature& feature : features) {
      feature.ideal_px = {static_cast<float>(640 * UniformReal(engine)),
                          static_cast<float>(480 * UniformReal(engine))};
      feature.depth_m = static_cast<float>(5 * UniformReal(engine));
      feature.descriptor = test::RandomDescriptor(engine);
    }
    Keyframe keyframe = test::MakeTestKeyframe(test::MakeTestFeatures(features),
                                               {ExpSo3({0, 0.01 * k, 0}), {0.1 * k, 0, 0}});
    const int known = std::min(k, 3) * kNewLandmarks;
    for (int i = 0; i < known; ++i) {
      keyframe.landmarks[i] = LandmarkId(static_cast<std::uint32_t>(k * kNewLandmarks - known + i));
    }
    const KeyframeId id = map.AddKeyframe(keyframe);
    for (int i = known; i < known + kNewLandmarks; ++i) {
      map.AddLandmark({UniformReal(engine), UniformReal(engine), 2 + UniformReal(engine)}, id, i);
    }
  }
  return map.Snapshot();
}

void SaveMapFile(benchmark::State& state) {
  const auto map = MakeMap(static_cast<int>(state.range(0)));
  const TestFolder folder;
  for (auto _ : state) SaveMap(folder.path() / "m.ofm", *map, {});
  state.counters["landmarks"] = static_cast<double>(map->landmark_count);
  state.counters["MB"] =
      1e-6 * static_cast<double>(std::filesystem::file_size(folder.path() / "m.ofm"));
}
BENCHMARK(SaveMapFile)
    ->ArgName("keyframes")
    ->Arg(50)
    ->Arg(500)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void LoadMapFile(benchmark::State& state) {
  const TestFolder folder;
  SaveMap(folder.path() / "m.ofm", *MakeMap(static_cast<int>(state.range(0))), {});
  for (auto _ : state) benchmark::DoNotOptimize(LoadMap(folder.path() / "m.ofm"));
}
BENCHMARK(LoadMapFile)
    ->ArgName("keyframes")
    ->Arg(50)
    ->Arg(500)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace ofm
