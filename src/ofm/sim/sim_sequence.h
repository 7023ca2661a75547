// A sequence of the simulated world, with its exact truth.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ofm/camera/pinhole_camera.h"
#include "ofm/geometry/trajectory.h"
#include "ofm/io/frame_source.h"
#include "ofm/sim/camera_path.h"
#include "ofm/sim/imaging.h"
#include "ofm/sim/renderer.h"
#include "ofm/sim/room.h"
#include "ofm/sim/sensor_noise.h"
#include "ofm/sim/world.h"

namespace ofm {

/// A camera without distortion that sees 63 degrees across, as the Kinect does.
PinholeCamera MakeSimCamera(int width_px, int height_px);

struct SimSequenceOptions {
  std::uint64_t seed = 1;  ///< decides the world, its movers and the noise
  int frames = 60;
  double rate_hz = 30;
  double start_s = 1000;  ///< stamp of the first frame [s]
  PinholeCamera camera = MakeSimCamera(320, 240);
  CameraPathOptions path;
  WorldOptions world;
  RoomOptions room;
  ImagingOptions imaging;
  SensorNoiseOptions noise;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("seed", self.seed, "decides the world, its movers and the noise", Range{0, 1e15});
    visit("frames", self.frames, "number of frames", Range{1, 1e6});
    visit("rate_hz", self.rate_hz, "frames per second", Range{0.1, 1000});
    visit("start_s", self.start_s, "stamp of the first frame [s]", Range{0, 4e9});
    visit("camera", self.camera);
    visit("path", self.path);
    visit("world", self.world);
    visit("room", self.room);
    visit("imaging", self.imaging);
    visit("noise", self.noise);
  }
};

/// A frame with its truth.
struct SimFrame {
  RgbdFrame frame;
  cv::Mat instance;  ///< CV_8UC1: InstanceId of everything that has a class, 0 elsewhere
};

/// Renders frames when they are asked for. The const members depend on nothing but the options
/// and may be called from several threads.
class SimSequence : public FrameSource {
 public:
  explicit SimSequence(const SimSequenceOptions& options);
  /// Another world than a room, with the options' camera, path and noise.
  SimSequence(const SimSequenceOptions& options, Scene scene);

  /// The frames in order, then nothing.
  std::optional<RgbdFrame> Next() override;
  std::optional<std::size_t> size() const override;
  /// Next() starts anew.
  void Rewind() { next_ = 0; }

  /// Frame `id`, whatever Next() gave; `id` is in [0, size()).
  RgbdFrame Frame(FrameId id) const;
  /// The same with its instances, at little more cost.
  SimFrame Render(FrameId id) const;
  /// Exact flow to where the next frame is, or would be: see RenderFlow.
  cv::Mat FlowToNext(FrameId id) const;
  /// Whole microseconds after the start, so that text files keep it exactly.
  std::int64_t StampNs(FrameId id) const;
  /// Seconds since the first frame: the time of the scene and of the path.
  double SceneTime(FrameId id) const;
  /// The true pose.
  RigidTransform WorldFromCamera(FrameId id) const;
  /// The true pose of every frame.
  Trajectory GroundTruth() const;
  /// CV_8UC1: InstanceId of everything that has a class, 0 elsewhere; names in
  /// scene().class_names().
  cv::Mat InstanceMask(FrameId id) const;
  /// The same with the movers alone: ids 1 to scene().mover_count().
  cv::Mat MoverMask(FrameId id) const;

  const SimSequenceOptions& options() const { return options_; }
  const PinholeCamera& camera() const { return options_.camera; }
  const Scene& scene() const { return scene_; }

 private:
  /// The colour image with what the shutter does; `sharp` is that of the frame's stamp.
  cv::Mat Expose(double time_s, const cv::Mat& sharp) const;

  SimSequenceOptions options_;
  Scene scene_;
  CameraPath path_;
  Renderer renderer_;
  SensorNoise noise_;
  std::uint32_t next_ = 0;
};

}  // namespace ofm
