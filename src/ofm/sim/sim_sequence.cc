#include "ofm/sim/sim_sequence.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/time.h"
#include "ofm/sim/scene_flow.h"

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
    : SimSequence(options, MakeWorld({options.world,
                                      options.room,
                                      {PeopleKind::kNone, options.frames / options.rate_hz,
                                       options.path, options.seed}})) {}

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

RgbdFrame SimSequence::Frame(FrameId id) const { return Render(id).frame; }

cv::Mat SimSequence::Expose(double time_s, const cv::Mat& sharp) const {
  // Of what is about 1.5 m away; people walk at about 1.2 m/s.
  constexpr double kDistance_m = 1.5, kPeople_mps = 1.2, kStep_s = 1e-3;
  const ImagingOptions& imaging = options_.imaging;
  cv::Mat color = sharp;
  if (imaging.exposure_s > 0) {
    const RigidTransform motion =
        path_.WorldFromCamera(time_s).Inverse() * path_.WorldFromCamera(time_s + kStep_s);
    const double people = scene_.mover_count() > 0 ? kPeople_mps / kDistance_m : 0;
    const double camera =
        (motion.RotationAngle() + motion.translation().norm() / kDistance_m) / kStep_s;
    color = BlurByMotion(imaging, time_s, options_.camera.fx * (camera + people), [&](double t) {
      return renderer_.Render(scene_, t, path_.WorldFromCamera(t)).color;
    });
  }
  ChangeExposure(imaging, time_s, color);
  return color;
}

SimFrame SimSequence::Render(FrameId id) const {
  RenderedImage image = renderer_.Render(scene_, SceneTime(id), WorldFromCamera(id));
  image.color = Expose(SceneTime(id), image.color);
  noise_.Apply(id.value, image);
  RgbdFrame frame;
  frame.id = id;
  frame.stamp_ns = frame.depth_stamp_ns = StampNs(id);
  frame.name = FormatSeconds(frame.stamp_ns);
  frame.color = image.color;
  frame.depth_m = image.depth_m;
  cv::cvtColor(frame.color, frame.gray, cv::COLOR_BGR2GRAY);
  return {frame, image.instance};
}

cv::Mat SimSequence::FlowToNext(FrameId id) const {
  const auto view = [this](double time_s) {
    return SceneView{time_s, path_.WorldFromCamera(time_s)};
  };
  const double time_s = SceneTime(id);
  return RenderFlow(renderer_, scene_, view(time_s), view(time_s + 1 / options_.rate_hz));
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
