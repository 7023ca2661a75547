// Time of AdjustBundle, and the error that it leaves, by size of the problem.
#include <benchmark/benchmark.h>

#include "ofm/estimation/bundle_adjustment.h"
#include "ofm/estimation/bundle_test_world.h"

namespace ofm {
namespace {

/// Local bundle adjustment: as many free poses as fixed ones, five views of each point, one in
/// twenty observations wrong.
void AdjustLocalBundle(benchmark::State& state) {
  test::BundleWorldOptions options;
  options.free_poses = options.fixed_poses = static_cast<int>(state.range(0));
  options.points = static_cast<int>(state.range(1));
  RandomEngine engine = MakeRandomEngine(1, 0);
  test::BundleWorld world = test::MakeBundleWorld(options, engine);
  test::SpoilEvery(20, world, engine);
  BundleResult result;
  for (auto _ : state) {
    result = AdjustBundle(world.camera, world.problem, {});
    benchmark::DoNotOptimize(result);
  }
  state.counters["observations"] = static_cast<double>(world.problem.observations.size());
  state.counters["error_mm"] = 1e3 * test::PositionError_m(world, result.camera_from_world);
  state.counters["final_cost"] = result.final_cost;
}
BENCHMARK(AdjustLocalBundle)
    ->ArgNames({"free_poses", "points"})
    ->Args({10, 1000})
    ->Args({20, 2000})
    ->Args({40, 4000})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ofm
