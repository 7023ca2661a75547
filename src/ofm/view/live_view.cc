#include "ofm/view/live_view.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/base/time.h"
#include "ofm/base/timing.h"
#include "ofm/pipeline/back_end.h"
#include "ofm/view/assets.h"

namespace ofm {
namespace {

/// Jobs that wait; of more the oldest are left out.
constexpr std::size_t kJobs = 16;
constexpr int kJpegQuality = 80;
/// Pictures are no wider on the page [px].
constexpr int kMaxWidth = 960;

DenseOptions CloudOptions(const LiveViewOptions& options) {
  DenseOptions dense;
  dense.resolution_m = options.cloud_resolution_m;
  return dense;
}

std::vector<unsigned char> ToJpeg(cv::Mat image) {
  if (image.cols > kMaxWidth) {
    const double scale = static_cast<double>(kMaxWidth) / image.cols;
    cv::resize(image, image, {}, scale, scale, cv::INTER_AREA);
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return bytes;
}

/// True, and `last_ns` is now, where the last time is a period ago.
bool IsDue(double per_second, std::int64_t now_ns, std::int64_t& last_ns) {
  if (now_ns - last_ns < SecondsToNanoseconds(1 / per_second)) return false;
  last_ns = now_ns;
  return true;
}

}  // namespace

LiveView::LiveView(const LiveViewOptions& options, const PinholeCamera& camera,
                   std::vector<std::string> class_names, std::optional<std::size_t> frames)
    : options_(options),
      class_names_(std::move(class_names)),
      frames_(frames),
      start_ns_(SteadyTimeNs()),
      cloud_maker_(camera, CloudOptions(options)),
      server_(options.server, LiveViewPages()),
      jobs_(kJobs, OverflowPolicy::kDropOldest),
      thread_([this](const std::stop_token& stop) { Work(stop); }) {
  PutText("classes", EncodeClasses(class_names_));
}

LiveView::~LiveView() {
  jobs_.Close();
  thread_.join();  // what waits is told
  PutText("end", EncodeEnd());
}

void LiveView::OnFrame(const FrameReport& report) {
  Job job;
  const std::int64_t now_ns = SteadyTimeNs();
  if (IsDue(options_.max_pictures_per_s, now_ns, picture_ns_)) {
    job.state = StateOf(report);
    job.picture = LivePicture{report.prepared, {}};
    for (const LandmarkId landmark : report.tracking.landmarks) {
      job.picture->in_pose.push_back(landmark.valid());
    }
  }
  if (report.map && IsDue(options_.max_map_updates_per_s, now_ns, map_ns_)) job.map = report.map;
  if (report.tracking.keyframe) job.keyframe = report.prepared;
  if (job.state || job.map || job.keyframe) jobs_.Push(std::move(job));
}

void LiveView::ShowMap(std::shared_ptr<const MapSnapshot> map) {
  Job job;
  job.map = std::move(map);
  jobs_.Push(std::move(job));
}

LiveState LiveView::StateOf(const FrameReport& report) const {
  LiveState state;
  state.frames_done = report.frames_done;
  state.frames = frames_;
  const double elapsed_s = NanosecondsToSeconds(SteadyTimeNs() - start_ns_);
  if (elapsed_s > 0) state.frames_per_s = static_cast<double>(report.frames_done) / elapsed_s;
  state.status = report.tracking.status;
  state.inliers = report.tracking.inliers;
  state.keyframes = report.keyframes;
  state.landmarks = report.landmarks;
  state.masked_share = report.prepared.dynamic.masked_share;
  if (HasPose(state.status)) state.world_from_camera = report.tracking.camera_from_world.Inverse();
  return state;
}

void LiveView::Work(const std::stop_token& stop) {
  while (const std::optional<Job> job = jobs_.Pop(stop)) {
    try {
      Tell(*job);
    } catch (const std::exception& error) {  // no reason for the run to end
      spdlog::warn("the live view leaves something out: {}", error.what());
    }
  }
}

void LiveView::Tell(const Job& job) {
  if (job.keyframe) {
    const KeyframeCloud cloud = cloud_maker_.Make(MakeLabelledFrame(*job.keyframe));
    const FrameId frame = job.keyframe->frame.id;
    PutBinary("cloud " + std::to_string(frame.value), EncodeCloud(frame, cloud.points_in_camera));
  }
  if (job.map) PutText("keyframes", EncodeKeyframes(*job.map));
  if (job.state) PutText("state", EncodeState(*job.state));
  if (job.picture) {
    PutBinary("picture", EncodeImage(ToJpeg(DrawLivePicture(*job.picture, class_names_))));
  }
}

void LiveView::PutText(const std::string& name, std::string text) {
  server_.Put(name, {std::make_shared<const std::string>(std::move(text)), true});
}

void LiveView::PutBinary(const std::string& name, std::string bytes) {
  server_.Put(name, {std::make_shared<const std::string>(std::move(bytes)), false});
}

}  // namespace ofm
