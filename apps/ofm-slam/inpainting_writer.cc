#include "inpainting_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <future>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "ofm/base/options.h"
#include "ofm/base/time.h"
#include "ofm/dense/background_inpainter.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/image_file.h"
#include "ofm/io/make_folder.h"
#include "png_writer.h"
#include "share_bar.h"

namespace ofm {
namespace {

/// A tracked frame of the sequence.
struct TrackedFrame {
  std::size_t index;  // in the sequence
  StampedPose pose;
};

/// The poses whose time is that of a frame of the sequence.
std::vector<TrackedFrame> FindFrames(const RgbdSequence& sequence, const Trajectory& trajectory) {
  std::map<std::int64_t, std::size_t> index_of_stamp;
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    index_of_stamp[sequence.entries()[i].color.stamp_ns] = i;
  }
  std::vector<TrackedFrame> frames;
  for (const StampedPose& pose : trajectory) {
    const auto found = index_of_stamp.find(pose.stamp_ns);
    if (found != index_of_stamp.end()) frames.push_back({found->second, pose});
  }
  return frames;
}

/// Frames of the sequence with their recorded masks.
class ViewReader {
 public:
  ViewReader(const RgbdSequence& sequence, const Trajectory& trajectory,
             std::filesystem::path masks)
      : sequence_(sequence), trajectory_(trajectory), masks_(std::move(masks)) {}

  SceneView Read(const TrackedFrame& tracked) const {
    const RgbdFrame frame = sequence_.Load(tracked.index);
    const RigidTransform& pose = tracked.pose.world_from_camera;
    return {tracked.pose.stamp_ns,
            pose,
            InterpolatePose(trajectory_, frame.depth_stamp_ns).value_or(pose),
            frame.color,
            frame.depth_m,
            LoadMaskImage(masks_ / (frame.name + ".png"), frame.color.size())};
  }

 private:
  const RgbdSequence& sequence_;
  const Trajectory& trajectory_;
  std::filesystem::path masks_;
};

/// The keyframes around the current frame, each read once while frames come in their order.
class KeyframeWindow {
 public:
  KeyframeWindow(const ViewReader& reader, const BackgroundInpainter& inpainter,
                 std::vector<TrackedFrame> keyframes, const InpaintingOptions& options)
      : reader_(reader),
        inpainter_(inpainter),
        keyframes_(std::move(keyframes)),
        options_(options) {}

  std::vector<std::shared_ptr<const StaticView>> Around(std::int64_t stamp_ns) {
    const auto after = std::upper_bound(
        keyframes_.begin(), keyframes_.end(), stamp_ns,
        [](std::int64_t stamp, const TrackedFrame& frame) { return stamp < frame.pose.stamp_ns; });
    const auto first =
        after - std::min<std::ptrdiff_t>(options_.keyframes_before, after - keyframes_.begin());
    const auto end =
        after + std::min<std::ptrdiff_t>(options_.keyframes_after, keyframes_.end() - after);
    std::map<std::size_t, std::shared_ptr<const StaticView>> still_read;
    std::vector<std::shared_ptr<const StaticView>> views;
    for (auto keyframe = first; keyframe != end; ++keyframe) {
      const auto known = read_.find(keyframe->index);
      views.push_back(known != read_.end() ? known->second : Make(*keyframe));
      still_read[keyframe->index] = views.back();
    }
    read_ = std::move(still_read);
    return views;
  }

 private:
  std::shared_ptr<const StaticView> Make(const TrackedFrame& keyframe) const {
    return std::make_shared<StaticView>(inpainter_.MakeStaticView(reader_.Read(keyframe)));
  }

  const ViewReader& reader_;
  const BackgroundInpainter& inpainter_;
  std::vector<TrackedFrame> keyframes_;  // by time
  InpaintingOptions options_;
  std::map<std::size_t, std::shared_ptr<const StaticView>> read_;  // by index
};

/// Fills frames and writes them, as many at a time as there are cores.
class FrameFiller {
 public:
  FrameFiller(const BackgroundInpainter& inpainter, std::filesystem::path folder,
              double depth_scale)
      : inpainter_(inpainter), folder_(std::move(folder)), depth_scale_(depth_scale) {}

  /// Waits while all cores are busy. Throws what went wrong with an earlier frame.
  void Fill(SceneView view, std::vector<std::shared_ptr<const StaticView>> sources,
            std::string name) {
    if (under_way_.size() >= std::max(1U, std::thread::hardware_concurrency())) WaitForOne();
    under_way_.push_back(
        std::async(std::launch::async, [this, view = std::move(view), sources = std::move(sources),
                                        name = std::move(name)] { Write(view, sources, name); }));
  }
  void WaitForAll() {
    while (!under_way_.empty()) WaitForOne();
  }

 private:
  void WaitForOne() {
    std::future<void> first = std::move(under_way_.front());
    under_way_.pop_front();
    first.get();
  }
  void Write(const SceneView& view, std::span<const std::shared_ptr<const StaticView>> sources,
             const std::string& name) const {
    const InpaintedFrame filled = inpainter_.Inpaint(view, sources);
    cv::Mat depth;
    filled.depth_m.convertTo(depth, CV_16UC1, depth_scale_);
    WritePng(folder_ / "rgb" / name, filled.color);
    WritePng(folder_ / "depth" / name, depth);
  }

  const BackgroundInpainter& inpainter_;
  std::filesystem::path folder_;
  double depth_scale_;
  std::deque<std::future<void>> under_way_;
};

}  // namespace

HiddenPixelRecorder::HiddenPixelRecorder(const std::filesystem::path& folder)
    : masks_(folder / "mask") {
  MakeFolder(masks_);
}

void HiddenPixelRecorder::OnFrame(const FrameReport& report) {
  const DynamicMask& dynamic = report.prepared.dynamic;
  const RgbdFrame& frame = report.prepared.frame;
  const cv::Mat& hidden = dynamic.unmapped.empty() ? dynamic.mask : dynamic.unmapped;
  WritePng(masks_ / (frame.name + ".png"),
           hidden.empty() ? cv::Mat::zeros(frame.color.size(), CV_8UC1) : hidden);
}

void WriteInpaintedFrames(const std::filesystem::path& folder, const RgbdSequence& sequence,
                          const RunOutcome& outcome, const DenseOptions& options,
                          const std::stop_token& stop) {
  MakeFolder(folder / "rgb");
  MakeFolder(folder / "depth");
  PinholeCamera camera = sequence.camera();
  const BackgroundInpainter inpainter(camera, options.cloud, options.inpainting);
  const ViewReader reader(sequence, outcome.trajectory, folder / "mask");
  KeyframeWindow window(reader, inpainter, FindFrames(sequence, outcome.keyframe_trajectory),
                        options.inpainting);
  FrameFiller filler(inpainter, folder, camera.depth_scale);
  const std::vector<TrackedFrame> frames = FindFrames(sequence, outcome.trajectory);
  std::string associations = "# time, colour, time, depth\n";
  // A stop that ended the run wants its frames filled; one that comes now does not.
  const bool may_stop = !stop.stop_requested();
  ShareBar bar("in-painting");
  for (std::size_t i = 0; i < frames.size() && !(may_stop && stop.stop_requested()); ++i) {
    const SceneView view = reader.Read(frames[i]);
    const TumEntry& entry = sequence.entries()[frames[i].index];
    const std::string name = entry.color.path.stem().string() + ".png";
    filler.Fill(view, window.Around(view.stamp_ns), name);
    associations += fmt::format("{0} rgb/{1} {2} depth/{1}\n", FormatSeconds(view.stamp_ns), name,
                                FormatSeconds(entry.depth.stamp_ns));
    bar.OnShare(static_cast<double>(i + 1) / static_cast<double>(frames.size()));
  }
  filler.WaitForAll();
  WriteFileAtomically(folder / "associations.txt", associations);
  WriteFileAtomically(folder / "camera.yaml", PrintOptionsYaml(OptionFields(camera)));
}

}  // namespace ofm
