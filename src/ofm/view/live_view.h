// Shows a run in a browser while it goes on.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "ofm/base/bounded_queue.h"
#include "ofm/dense/keyframe_cloud.h"
#include "ofm/pipeline/run_observer.h"
#include "ofm/view/live_messages.h"
#include "ofm/view/live_picture.h"
#include "ofm/view/web_server.h"

namespace ofm {

struct LiveViewOptions {
  WebServerOptions server;
  double max_pictures_per_s = 10;
  double max_map_updates_per_s = 2;
  double cloud_resolution_m = 0.05;  ///< points of a key frame's cloud lie about as far apart
};

/// Serves a page with the current frame, its masks and features, the camera, the keyframes and
/// their clouds, which move with the map. The tracking thread hands values over and waits for
/// nothing: a thread of its own makes pictures and clouds, and leaves out what it has no time for.
class LiveView : public RunObserver {
 public:
  /// Serves from now on. `frames` in all, where known. Throws Error as WebServer does.
  LiveView(const LiveViewOptions& options, const PinholeCamera& camera,
           std::vector<std::string> class_names, std::optional<std::size_t> frames);
  /// Tells the viewers that the run has ended.
  ~LiveView() override;
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  std::string url() const { return server_.url(); }
  void OnFrame(const FrameReport& report) override;
  /// Shows where the map has its keyframes, after the run.
  void ShowMap(std::shared_ptr<const MapSnapshot> map);

 private:
  /// Work for the thread; what is empty is not told.
  struct Job {
    std::optional<LivePicture> picture;
    std::optional<LiveState> state;
    std::shared_ptr<const MapSnapshot> map;
    std::optional<PreparedFrame> keyframe;
  };

  LiveState StateOf(const FrameReport& report) const;
  void Work(const std::stop_token& stop);
  void Tell(const Job& job);
  void PutText(const std::string& name, std::string text);
  void PutBinary(const std::string& name, std::string bytes);

  LiveViewOptions options_;
  std::vector<std::string> class_names_;
  std::optional<std::size_t> frames_;
  std::int64_t start_ns_, picture_ns_ = 0, map_ns_ = 0;  // of the last of each
  KeyframeCloudMaker cloud_maker_;
  WebServer server_;
  BoundedQueue<Job> jobs_;
  std::jthread thread_;
};

}  // namespace ofm
