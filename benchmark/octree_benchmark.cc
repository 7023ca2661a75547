// Time to add key frames to the semantic octree, against OctoMap's own insertion of the same
// clouds.
#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include <algorithm>

#include "ofm/base/timing.h"
#include "ofm/dense/semantic_mapper.h"
#include "rgbd_samples.h"

namespace ofm {
namespace {

constexpr int kFramesPerKeyframe = 6;  // about what tracking chooses

/// Every sixth frame of the real recording with its true pose; a synthetic one where it is missing.
struct Recording {
  PinholeCamera camera;
  std::vector<LabelledFrame> keyframes;
  std::vector<RigidTransform> world_from_camera;
};

const Recording& GetRecording() {
  static const Recording recording = [] {
    const RgbdSampleSource source(OFM_SHARED_DIR "/data/tum_fr1_desk",
                                  *FindCameraPreset("tum-fr1"));
    Recording made{source.camera(), {}, {}};
    for (int i = 0; i < source.size(); i += kFramesPerKeyframe) {
      const RgbdSample sample = source.Read(i);
      LabelledFrame frame;
      frame.id = KeyframeId(static_cast<std::uint32_t>(made.keyframes.size()));
      frame.depth_m = sample.depth_m;
      frame.color = cv::Mat(sample.depth_m.size(), CV_8UC3, cv::Scalar(80, 120, 160));
      frame.class_ids = cv::Mat(sample.depth_m.size(), CV_8UC1, cv::Scalar(7));
      frame.confidence = cv::Mat(sample.depth_m.size(), CV_8UC1, cv::Scalar(200));
      made.keyframes.push_back(frame);
      made.world_from_camera.push_back(sample.world_from_camera);
    }
    return made;
  }();
  return recording;
}

DenseOptions Options(const benchmark::State& state) {
  DenseOptions options;
  options.resolution_m = static_cast<double>(state.range(0)) / 100;
  return options;
}

std::vector<WorldScan> MakeScans(const DenseOptions& options) {
  const Recording& recording = GetRecording();
  const KeyframeCloudMaker maker(recording.camera, options);
  std::vector<WorldScan> scans;
  for (std::size_t i = 0; i < recording.keyframes.size(); ++i) {
    scans.push_back(
        TransformToWorld(maker.Make(recording.keyframes[i]), recording.world_from_camera[i]));
  }
  return scans;
}

class KeyframeTimes {
 public:
  template <class Step>
  void Take(Step&& step) {
    const std::int64_t start_ns = ThreadCpuTimeNs();
    step();
    times_ms_.push_back(static_cast<double>(ThreadCpuTimeNs() - start_ns) * 1e-6);
  }
  void Report(benchmark::State& state) const {
    const DurationStatistics statistics = Summarize(times_ms_);
    state.counters["keyframe_median_ms"] = statistics.median_ms;
    state.counters["keyframe_p99_ms"] = statistics.p99_ms;
  }

 private:
  std::vector<double> times_ms_;
};

/// Occupancy, colour and labels. With the neighbours of hits not spared the occupancies are those
/// of OctoMap.
void InsertIntoSemanticOctree(benchmark::State& state, bool spare_neighbours) {
  DenseOptions options = Options(state);
  options.occupancy.spare_neighbours = spare_neighbours;
  const std::vector<WorldScan> scans = MakeScans(options);
  KeyframeTimes times;
  std::size_t voxels = 0, bytes = 0;
  for (auto _ : state) {
    SemanticOctree octree(options.resolution_m, options.occupancy);
    for (const WorldScan& scan : scans) times.Take([&] { octree.InsertScan(scan); });
    state.PauseTiming();
    voxels = 0;
    octree.ForEach([&](const VoxelIndex&, const SemanticVoxel&) { ++voxels; });
    bytes = octree.MemoryBytes();
    state.ResumeTiming();
  }
  times.Report(state);
  state.counters["voxels"] = static_cast<double>(voxels);
  state.counters["MiB"] = static_cast<double>(bytes) / (1 << 20);
}

/// Occupancy alone, by insertPointCloud with `discretize`, whose occupancies are the same (a test
/// of SemanticOctree shows it); points beyond the range free the space before it, as ours do.
void InsertIntoOctoMap(benchmark::State& state) {
  const DenseOptions options = Options(state);
  std::vector<octomap::Pointcloud> clouds;
  const std::vector<WorldScan> scans = MakeScans(options);
  for (const WorldScan& scan : scans) {
    octomap::Pointcloud& cloud = clouds.emplace_back();
    const Eigen::Vector3f& origin = scan.origin;
    for (const LabelledPoint& p : scan.points)
      cloud.push_back(p.position.x(), p.position.y(), p.position.z());
    for (const Eigen::Vector3f& end : scan.free_ends) {
      const Eigen::Vector3f beyond = origin + 1.01F * (end - origin);
      cloud.push_back(beyond.x(), beyond.y(), beyond.z());
    }
  }
  KeyframeTimes times;
  std::size_t voxels = 0, bytes = 0;
  for (auto _ : state) {
    octomap::OcTree tree(options.resolution_m);
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      const Eigen::Vector3f& o = scans[i].origin;
      times.Take([&] {
        tree.insertPointCloud(clouds[i], {o.x(), o.y(), o.z()}, options.range_m, false, true);
      });
    }
    state.PauseTiming();
    bytes = tree.memoryUsage();
    tree.expand();
    voxels = tree.getNumLeafNodes();
    state.ResumeTiming();
  }
  times.Report(state);
  state.counters["voxels"] = static_cast<double>(voxels);
  state.counters["MiB"] = static_cast<double>(bytes) / (1 << 20);
}

/// From the images: choice of pixels, back-projection, voxel filter and insertion.
void IntegrateKeyframe(benchmark::State& state) {
  const DenseOptions options = Options(state);
  const Recording& recording = GetRecording();
  const KeyframeCloudMaker maker(recording.camera, options);
  KeyframeTimes times;
  for (auto _ : state) {
    SemanticOctree octree(options.resolution_m, options.occupancy);
    for (std::size_t i = 0; i < recording.keyframes.size(); ++i) {
      times.Take([&] {
        octree.InsertScan(
            TransformToWorld(maker.Make(recording.keyframes[i]), recording.world_from_camera[i]));
      });
    }
  }
  times.Report(state);
}

void AtBothResolutions(benchmark::internal::Benchmark* made) {
  made->ArgName("cm")->Arg(5)->Arg(2)->Unit(benchmark::kMillisecond)->Iterations(2);
}
BENCHMARK_CAPTURE(InsertIntoSemanticOctree, as_octomap, false)->Apply(AtBothResolutions);
BENCHMARK_CAPTURE(InsertIntoSemanticOctree, sparing_neighbours, true)->Apply(AtBothResolutions);
BENCHMARK(InsertIntoOctoMap)->Apply(AtBothResolutions);
BENCHMARK(IntegrateKeyframe)->Apply(AtBothResolutions);

}  // namespace
}  // namespace ofm
