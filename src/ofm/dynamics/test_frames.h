// Pairs of lattice frames made by hand, and frames of a simulated room with people. Tests only.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "ofm/base/random.h"
#include "ofm/dynamics/camera_motion.h"
#include "ofm/perception/segmentation.h"
#include "ofm/sim/sim_sequence.h"

namespace ofm::test {

/// The points p of a camera's frame with normal · p = distance_m.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d(0.2, -0.1, 1).normalized();
  double distance_m = 2.5;

  double DepthAt(const PinholeCamera& camera, const Eigen::Vector2d& px) const {
    return distance_m / normal.dot(camera.UnprojectIdeal(px, 1));
  }
  Plane SeenAfter(const RigidTransform& motion) const {
    const Eigen::Vector3d turned = motion.RotationMatrix() * normal;
    return {turned, distance_m + turned.dot(motion.translation())};
  }
};

/// A rectangle of cells that moves by itself.
struct MadeMover {
  cv::Rect cells = {30, 20, 20, 20};  ///< in the current frame
  float depth_m = 1.5F;
  cv::Vec2f own_flow = {0, 0};   ///< [cells], besides what the camera makes
  float last_depth_m = depth_m;  ///< in the last frame
};

/// Two views of a plane with exact flow and depth; everything has texture, nothing has been
/// believed to move.
class MadePair {
 public:
  explicit MadePair(const RigidTransform& last_from_current, const Plane& plane = {})
      : motion_(last_from_current) {
    const Plane before = plane.SeenAfter(last_from_current);
    for (LatticeFrame* frame : {&current, &last}) {
      frame->gray = cv::Mat(2 * camera.height, 2 * camera.width, CV_8UC1, cv::Scalar(100));
      frame->depth_m.create(camera.height, camera.width, CV_32FC1);
      frame->texture = cv::Mat(frame->depth_m.size(), CV_8UC1, cv::Scalar(255));
    }
    flow.create(current.depth_m.size(), CV_32FC2);
    belief = cv::Mat(flow.size(), CV_32FC1, cv::Scalar(-0.3));
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        current.depth_m.at<float>(y, x) = static_cast<float>(plane.DepthAt(camera, {x, y}));
        last.depth_m.at<float>(y, x) = static_cast<float>(before.DepthAt(camera, {x, y}));
        flow.at<cv::Vec2f>(y, x) = StaticFlow({x, y});
      }
    }
    last.stamp_ns = last.depth_stamp_ns = 1'000'000'000;
    current.stamp_ns = current.depth_stamp_ns = 1'033'000'000;
  }

  void Add(const MadeMover& mover) {
    current.depth_m(mover.cells) = mover.depth_m;
    for (int y = mover.cells.y; y < mover.cells.br().y; ++y) {
      for (int x = mover.cells.x; x < mover.cells.br().x; ++x) {
        flow.at<cv::Vec2f>(y, x) = StaticFlow({x, y}) + mover.own_flow;
      }
    }
    const cv::Vec2f middle = flow.at<cv::Vec2f>((mover.cells.tl() + mover.cells.br()) / 2);
    const cv::Point step(static_cast<int>(std::lround(middle[0])),
                         static_cast<int>(std::lround(middle[1])));
    last.depth_m((mover.cells + step) & cv::Rect({}, flow.size())) = mover.last_depth_m;
  }

  /// The flow that the camera's motion makes of what `current` shows at a cell [cells].
  cv::Vec2f StaticFlow(cv::Point cell) const {
    const Eigen::Vector2d here(cell.x, cell.y);
    const Eigen::Vector2d there =
        camera.ProjectIdeal(motion_ * camera.UnprojectIdeal(here, current.depth_m.at<float>(cell)));
    return {static_cast<float>(there.x() - cell.x), static_cast<float>(there.y() - cell.y)};
  }
  LatticePair pair() const { return {current, last, flow, belief}; }
  const RigidTransform& motion() const { return motion_; }

  PinholeCamera camera = MakeSimCamera(80, 60);  // its pixels are the cells
  LatticeFrame current, last;
  cv::Mat flow, belief;

 private:
  RigidTransform motion_;
};

inline RigidTransform SmallMotion() {
  return {ExpSo3({0.004, -0.008, 0.006}), {0.03, -0.02, 0.04}};
}

/// `rect` less `margin` cells on each side.
inline cv::Rect Inner(const cv::Rect& rect, int margin) {
  return {rect.x + margin, rect.y + margin, rect.width - 2 * margin, rect.height - 2 * margin};
}

/// Share of the cells in `area` where `image` (CV_32FC1) is over 0.
inline double SharePositive(const cv::Mat& image, const cv::Rect& area) {
  return cv::countNonZero(image(area) > 0) / static_cast<double>(area.area());
}

/// Share of the pixels of `mask` that are set among those where `where` is not 0.
inline double ShareSet(const cv::Mat& mask, const cv::Mat& where) {
  const int all = cv::countNonZero(where);
  return all == 0 ? 0 : cv::countNonZero(mask & (where != 0)) / static_cast<double>(all);
}

/// A room seen by a camera that moves about, and people who walk through the view.
inline SimSequenceOptions WalkingRoom(int frames, int people) {
  SimSequenceOptions options;
  options.frames = frames;
  options.camera = MakeSimCamera(640, 480);
  options.room.people = people;
  options.path.kind = CameraPathKind::kHalfsphere;
  options.noise.model = NoiseModel::kKinect;
  return options;
}

/// Its frames, rendered once for all tests of a program.
struct WalkingRecording {
  static const WalkingRecording& Get(int people) {
    static const WalkingRecording empty(0), one(1), crowd(4);
    return people == 0 ? empty : people == 1 ? one : crowd;
  }

  static constexpr std::uint32_t kFrames = 12;
  SimSequence sequence;
  std::vector<RgbdFrame> frames;

 private:
  explicit WalkingRecording(int people) : sequence(WalkingRoom(kFrames, people)) {
    while (auto frame = sequence.Next()) frames.push_back(std::move(*frame));
  }
};

inline RigidTransform LastFromCurrent(const SimSequence& sequence, FrameId current) {
  return sequence.WorldFromCamera(FrameId(current.value - 1)).Inverse() *
         sequence.WorldFromCamera(current);
}

/// One instance of class 0.
inline Segmentation OneInstance(FrameId frame, const cv::Mat& mask) {
  return {frame, {{InstanceId(1), ClassId(0), 0.9F, cv::boundingRect(mask), mask}}};
}

}  // namespace ofm::test
