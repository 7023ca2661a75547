#include "ofm/sim/sim_sequence.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/time.h"

namespace ofm {

PinholeCamera MakeSimCamera(int width_px, int height_px) {
  constexpr double kFocalPerWidth = 0.82;
  PinholeCamera camera;
  camera.width = width_px;
  camera.height = height_px;
  camera.fx = camera.fy = kFocalPerWidth * width_px;
  camera.cx = 0.5 * (width_px - 1);
  camera.cy = 0.5 * (height_px - 1);
  return camera;
}

SimSequence::SimSequence(const SimSequenceOptions& options)
    : SimSequence(options, MakeRoom(options.room, options.seed)) {}

SimSequence::SimSequence(const SimSequenceOptions& options, Scene scene)
    : options_(options),
      scene_(std::move(scene)),
      path_(options.path, scene_.viewpoint()),
      renderer_(options.camera),
      noise_(options.noise, options.camera, options.seed) {
  OFM_CHECK(options.frames > 0 && options.rate_hz > 0);
}

std::optional<RgbdFrame> SimSequence::Next() {
  if (next_ >= static_cast<std::uint32_t>(options_.frames)) return {};
  return Frame(FrameId(next_++));
}

std::optional<std::size_t> SimSequence::size() const {
  return static_cast<std::size_t>(options_.frames);
}

std::int64_t SimSequence::StampNs(FrameId id) const {
  OFM_CHECK(id.value < static_cast<std::uint32_t>(options_.frames));
  constexpr std::int64_t kMicrosecondNs = 1000;
  const std::int64_t start_us = std::llround(options_.start_s * 1e6);
  const std::int64_t since_us = std::llround(id.value * 1e6 / options_.rate_hz);
  return (start_us + since_us) * kMicrosecondNs;
}

double SimSequence::SceneTime(FrameId id) const {
  return NanosecondsToSeconds(StampNs(id) - StampNs(FrameId(0)));
}

RigidTransform SimSequence::WorldFromCamera(FrameId id) const {
  return path_.WorldFromCamera(SceneTime(id));
}

Trajectory SimSequence::GroundTruth() const {
  Trajectory trajectory;
  for (int i = 0; i < options_.frames; ++i) {
    const FrameId id(static_cast<std::uint32_t>(i));
    trajectory.push_back({StampNs(id), WorldFromCamera(id)});
  }
  return trajectory;
}

RgbdFrame SimSequence::Frame(FrameId id) const {
  RenderedImage image = renderer_.Render(scene_, SceneTime(id), WorldFromCamera(id));
  noise_.Apply(id.value, image);
  RgbdFrame frame;
  frame.id = id;
  frame.stamp_ns = frame.depth_stamp_ns = StampNs(id);
  frame.name = FormatSeconds(frame.stamp_ns);
  frame.color = image.color;
  frame.depth_m = image.depth_m;
  cv::cvtColor(frame.color, frame.gray, cv::COLOR_BGR2GRAY);
  return frame;
}

cv::Mat SimSequence::InstanceMask(FrameId id) const {
  return renderer_.RenderInstances(scene_, SceneTime(id), WorldFromCamera(id));
}

cv::Mat SimSequence::MoverMask(FrameId id) const {
  cv::Mat mask = InstanceMask(id);
  mask.setTo(0, mask > scene_.mover_count());
  return mask;
}

}  // namespace ofm
