// Time and quality of segmentation, optical flow and dynamic culling on a sequence with true masks:
// the one named by OFM_SEQUENCE, else ../sequences/desk_walking (tools/compose_dynamic.py makes
// it).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/dynamics/dynamics_stage.h"
#include "ofm/dynamics/mask_dilation.h"
#include "ofm/perception/class_names.h"
#include "ofm/perception/optical_flow.h"
#include "ofm/perception/yolo_seg_segmenter.h"

namespace ofm {
namespace {

namespace fs = std::filesystem;

const fs::path kShared = OFM_SHARED_DIR;

fs::path SequenceFolder() {
  const char* folder = std::getenv("OFM_SEQUENCE");
  return folder != nullptr ? fs::path(folder) : kShared / "../sequences/desk_walking";
}

/// Colour images in order of time.
std::vector<fs::path> ColorFiles() {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(SequenceFolder() / "rgb", error)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

RgbdFrame ReadFrame(const fs::path& path) {
  RgbdFrame frame;
  frame.name = path.stem().string();
  frame.color = cv::imread(path.string());
  cv::cvtColor(frame.color, frame.gray, cv::COLOR_BGR2GRAY);
  return frame;
}

/// 255 where an actor is; empty where the sequence has no masks.
cv::Mat ReadActors(const std::string& name) {
  const cv::Mat ids =
      cv::imread((SequenceFolder() / "mask" / (name + ".png")).string(), cv::IMREAD_UNCHANGED);
  return ids.empty() ? ids : cv::Mat(ids != 0);
}

/// Pixels found, true, and both.
struct Overlap {
  double found = 0, actual = 0, both = 0;

  void Add(const cv::Mat& mask, const cv::Mat& truth) {
    found += cv::countNonZero(mask);
    actual += cv::countNonZero(truth);
    both += cv::countNonZero(mask & truth);
  }
  double recall() const { return both / std::max(1.0, actual); }
  double precision() const { return both / std::max(1.0, found); }
};

/// Every 16th frame: what of the actors' pixels is on a person, by dilation.
void SegmentPeople(benchmark::State& state, const std::string& model) {
  const std::vector<fs::path> files = ColorFiles();
  if (files.empty() || !fs::exists(kShared / "models" / model)) {
    return state.SkipWithError("sequence or model is absent");
  }
  cv::setNumThreads(1);
  YoloSegSegmenter segmenter({kShared / "models" / model, CocoClassNames(), {}}, {});
  std::map<int, Overlap> overlaps;
  int with_actors = 0, missed = 0;
  std::size_t index = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const RgbdFrame frame = ReadFrame(files[index % files.size()]);
    index += 16;
    state.ResumeTiming();
    const Segmentation segmentation = segmenter.Segment(frame);
    state.PauseTiming();
    const cv::Mat actors = ReadActors(frame.name);
    for (const int radius : {0, 5, 7, 10, 15}) {
      cv::Mat people = cv::Mat::zeros(frame.gray.size(), CV_8UC1);
      for (const Instance& instance : segmentation.instances) {
        if (instance.class_id == ClassId(0)) AddDilated(instance.mask, radius, people);
      }
      overlaps[radius].Add(people, actors);
      if (radius != 0 || cv::countNonZero(actors) < 1500) continue;
      ++with_actors;
      missed += 2 * cv::countNonZero(people & actors) < cv::countNonZero(actors);
    }
    state.ResumeTiming();
  }
  for (const auto& [radius, overlap] : overlaps) {
    state.counters["recall_" + std::to_string(radius)] = overlap.recall();
    state.counters["precision_" + std::to_string(radius)] = overlap.precision();
  }
  state.counters["frames_half_missed"] = missed / std::max(1.0, static_cast<double>(with_actors));
}
BENCHMARK_CAPTURE(SegmentPeople, yolov8n_480x640, "yolov8n-seg_480x640.onnx")
    ->Iterations(36)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SegmentPeople, yolov8n_256x320, "yolov8n-seg_256x320.onnx")
    ->Iterations(36)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(SegmentPeople, yolo11n_384x512, "yolo11n-seg_384x512.onnx")
    ->Iterations(36)
    ->Unit(benchmark::kMillisecond);

std::vector<Eigen::Vector2f> FindCorners(const cv::Mat& gray, int count) {
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(gray, corners, count, 0.001, 7);
  std::vector<Eigen::Vector2f> points;
  for (const cv::Point2f& corner : corners) points.emplace_back(corner.x, corner.y);
  return points;
}

/// One image's pyramid and the flow of 1000 points into it, with and without the way back.
void FollowPoints(benchmark::State& state) {
  const std::vector<fs::path> files = ColorFiles();
  if (files.empty()) return state.SkipWithError("sequence is absent");
  cv::setNumThreads(1);
  OpticalFlowOptions options;
  options.window_px = static_cast<int>(state.range(0));
  options.epsilon_px = static_cast<double>(state.range(1)) / 100;
  options.forward_backward_px = static_cast<double>(state.range(2));
  OpticalFlow flow(options);
  std::vector<Eigen::Vector2f> points;
  double given = 0, tracked = 0;
  std::size_t index = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const RgbdFrame frame = ReadFrame(files[index++ % files.size()]);
    state.ResumeTiming();
    const FlowResult result = flow.Advance(frame.gray, points);
    state.PauseTiming();
    given += static_cast<double>(result.size());
    tracked += static_cast<double>(
        std::count(result.status.begin(), result.status.end(), FlowStatus::kTracked));
    points = FindCorners(frame.gray, 1000);
    state.ResumeTiming();
  }
  state.counters["tracked_share"] = tracked / std::max(1.0, given);
  state.counters["points"] = given / static_cast<double>(index);
}
BENCHMARK(FollowPoints)
    ->ArgNames({"window_px", "epsilon_cpx", "forward_backward_px"})
    ->Args({21, 1, 0})
    ->Args({21, 3, 0})
    ->Args({15, 3, 0})
    ->Args({11, 3, 0})
    ->Args({15, 3, 1})
    ->Iterations(25)
    ->Unit(benchmark::kMillisecond);

/// Verdicts by flow alone (no masks) on the first frames: of the tracked points on actors and on
/// the static scene, the shares found moving.
void CullByFlow(benchmark::State& state) {
  const std::vector<fs::path> files = ColorFiles();
  if (files.empty()) return state.SkipWithError("sequence is absent");
  cv::setNumThreads(1);
  OpticalFlowOptions flow_options;
  flow_options.window_px = static_cast<int>(state.range(0));
  flow_options.epsilon_px = static_cast<double>(state.range(1)) / 100;
  flow_options.forward_backward_px = static_cast<double>(state.range(2));
  OpticalFlow flow(flow_options);
  DynamicsStage stage({.mode = DynamicsMode::kPaper}, *FindCameraPreset("tum-fr1"), {});
  std::vector<Eigen::Vector2f> points;
  double actor_points = 0, static_points = 0, actor_moving = 0, static_moving = 0, masked = 0;
  std::size_t index = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const RgbdFrame frame = ReadFrame(files[index++ % files.size()]);
    const FlowResult result = flow.Advance(frame.gray, points);
    state.ResumeTiming();
    const DynamicMask dynamic = stage.Process({frame, {}, result, {}});
    state.PauseTiming();
    const cv::Mat truth = ReadActors(frame.name);
    const auto is_actor = [&](const Eigen::Vector2f& p) {
      return !truth.empty() && truth.at<std::uint8_t>(cv::Point(cvRound(p.x()), cvRound(p.y())));
    };
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (result.IsTracked(i)) ++(is_actor(result.current[i]) ? actor_points : static_points);
    }
    for (const auto& point : dynamic.dynamic_points) {
      ++(is_actor(point) ? actor_moving : static_moving);
    }
    masked += dynamic.masked_share;
    points = FindCorners(frame.gray, 1000);
    state.ResumeTiming();
  }
  state.counters["actor_points_found"] = actor_moving / std::max(1.0, actor_points);
  state.counters["static_points_lost"] = static_moving / std::max(1.0, static_points);
  state.counters["masked_share"] = masked / static_cast<double>(index);
}
BENCHMARK(CullByFlow)
    ->ArgNames({"window_px", "epsilon_cpx", "forward_backward_px"})
    ->Args({21, 1, 0})
    ->Args({15, 3, 0})
    ->Args({15, 3, 1})
    ->Iterations(120)
    ->Unit(benchmark::kMillisecond);

/// The masks' part: two people over a third of the image.
void DilatePeople(benchmark::State& state) {
  cv::setNumThreads(1);
  cv::Mat people = cv::Mat::zeros(480, 640, CV_8UC1);
  cv::ellipse(people, {180, 260}, {70, 220}, 5, 0, 360, cv::Scalar(255), cv::FILLED);
  cv::ellipse(people, {450, 260}, {80, 230}, -5, 0, 360, cv::Scalar(255), cv::FILLED);
  for (auto _ : state) {
    cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
    AddDilated(people, static_cast<int>(state.range(0)), mask);
    benchmark::DoNotOptimize(mask.data);
  }
}
BENCHMARK(DilatePeople)->ArgName("radius_px")->Arg(7)->Arg(15)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ofm
