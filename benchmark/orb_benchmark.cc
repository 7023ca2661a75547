// Time and quality of our ORB beside cv::ORB on the same frames:
//   build/release/bin/orb_benchmark [--benchmark_...]
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "feature_quality.h"
#include "ofm/base/timing.h"
#include "ofm/features/orb_extractor.h"
#include "ofm/features/orb_kernels.h"
#include "rgbd_samples.h"

namespace ofm {
namespace {

const RgbdSampleSource& Source() {
  static const RgbdSampleSource source(OFM_SHARED_DIR "/data/tum_fr1_desk",
                                       *FindCameraPreset("tum-fr1"));
  return source;
}

const std::vector<cv::Mat>& TimingFrames() {
  static const std::vector<cv::Mat> frames = [] {
    std::vector<cv::Mat> images;
    const int step = std::max(1, Source().size() / 60);
    for (int i = 0; i < Source().size(); i += step) images.push_back(Source().Read(i).gray);
    return images;
  }();
  return frames;
}

struct Contestant {
  const char* name;
  Extraction extract;
  std::vector<double> times_ms = {};

  double Quantile_ms(double share) {
    std::sort(times_ms.begin(), times_ms.end());
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  }
};

Extraction Ours(const OrbKernels& kernels, const OrbOptions& options = {}) {
  auto extractor = std::make_shared<OrbExtractor>(options, kernels);
  return [extractor](const cv::Mat& gray) { return extractor->Extract(gray); };
}

std::vector<Contestant>& Contestants() {
  // cv::ORB takes the strongest corners wherever they are; evenness 0.1 nearly does so too.
  static std::vector<Contestant> contestants = {
      {"ofm::OrbExtractor", Ours(BestOrbKernels())},
      {"evenness 0.1", Ours(BestOrbKernels(), {.evenness = 0.1})},
      {"  portable kernels", Ours(PortableOrbKernels())},
      {"cv::ORB", OpenCvOrb(OrbOptions().count)}};
  return contestants;
}

void BM_Extract(benchmark::State& state, int contestant) {
  Contestant& c = Contestants()[contestant];
  std::size_t frame = 0;
  for (auto _ : state) {
    const cv::Mat& gray = TimingFrames()[frame++ % TimingFrames().size()];
    const std::int64_t start_ns = ThreadCpuTimeNs();
    benchmark::DoNotOptimize(c.extract(gray));
    c.times_ms.push_back(static_cast<double>(ThreadCpuTimeNs() - start_ns) * 1e-6);
  }
}

void PrintTimes() {
  std::vector<Contestant>& contestants = Contestants();
  if (std::ranges::any_of(contestants, [](const Contestant& c) { return c.times_ms.empty(); })) {
    return;
  }
  const double reference_ms = contestants.back().Quantile_ms(0.5);
  fmt::print("\n{:22} {:>11} {:>9} {:>12}\n", "CPU per frame", "median ms", "p99 ms", "/ cv::ORB");
  for (Contestant& c : contestants) {
    fmt::print("{:22} {:11.2f} {:9.2f} {:12.2f}\n", c.name, c.Quantile_ms(0.5), c.Quantile_ms(0.99),
               c.Quantile_ms(0.5) / reference_ms);
  }
}

FeatureQuality Measure(const Extraction& extract, int gap) {
  constexpr int kPairs = 24;
  FeatureQuality quality;
  const int step = std::max(1, (Source().size() - gap) / kPairs);
  for (int i = 0; i + gap < Source().size(); i += step) {
    const RgbdSample a = Source().Read(i), b = Source().Read(i + gap);
    AddPair(Source().camera(), a, b, extract(a.gray), extract(b.gray), OrbOptions().scale_factor,
            quality);
  }
  return quality;
}

void PrintQuality() {
  fmt::print("\n{} frames of {}\n", Source().size(),
             Source().is_real() ? "tum_fr1_desk" : "a synthetic wall");
  fmt::print("{:22} {:>4} {:>13} {:>14} {:>12} {:>16}\n", "quality", "gap", "repeatability",
             "correct share", "correct", "median error px");
  for (const int gap : {1, 5, 15}) {
    for (const Contestant& c : Contestants()) {
      if (c.name[0] == ' ') continue;  // gives the same features
      const FeatureQuality q = Measure(c.extract, gap);
      fmt::print("{:22} {:4} {:13.3f} {:14.3f} {:12.1f} {:16.3f}\n", c.name, gap, q.Repeatability(),
                 q.CorrectRatio(), q.CorrectPerPair(), q.MedianError_px());
    }
  }
}

}  // namespace
}  // namespace ofm

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  for (int i = 0; i < static_cast<int>(ofm::Contestants().size()); ++i) {
    benchmark::RegisterBenchmark(ofm::Contestants()[i].name,
                                 [i](benchmark::State& state) { ofm::BM_Extract(state, i); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(180);
  }
  benchmark::RunSpecifiedBenchmarks();
  ofm::PrintTimes();
  ofm::PrintQuality();
  return 0;
}
