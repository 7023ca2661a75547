// Time of OptimizePose, and the error that it leaves, by number of observations.
#include <benchmark/benchmark.h>

#include <cmath>

#include "ofm/estimation/pose_optimizer.h"
#include "ofm/estimation/test_world.h"

namespace ofm {
namespace {

/// A tracked frame: half with depth, a tenth wrong, 2 cm and 1 degree beside the truth.
void OptimizePoseOfFrame(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const int wrong = static_cast<int>(state.range(1)) * count / 100;
  const PinholeCamera camera = *FindCameraPreset("tum-fr1");
  RandomEngine engine = MakeRandomEngine(1, 0);
  const RigidTransform truth;
  auto frame = test::MakeFrame(camera, truth, count, test::Depths::kEverySecond, {}, engine);
  test::Spoil(camera, wrong, frame, engine);
  const RigidTransform guess = ExpSe3(test::RandomTwist(engine, 0.02, 0.02)) * truth;
  PoseEstimate estimate;
  for (auto _ : state) {
    estimate = OptimizePose(camera, guess, frame, {});
    benchmark::DoNotOptimize(estimate);
  }
  const Vector6d error = test::Difference(estimate.camera_from_world, truth);
  state.counters["error_mm"] = 1e3 * error.head<3>().norm();
  state.counters["error_mrad"] = 1e3 * error.tail<3>().norm();
  state.counters["inliers"] = estimate.inlier_count;
}
BENCHMARK(OptimizePoseOfFrame)
    ->ArgNames({"observations", "wrong_percent"})
    ->Args({300, 10})
    ->Args({1000, 0})
    ->Args({1000, 10})
    ->Args({1000, 30})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ofm
