// Which cells of a frame move by themselves: all evidence joined.
#pragma once

#include <optional>

#include "ofm/dynamics/camera_motion.h"
#include "ofm/dynamics/free_space.h"
#include "ofm/perception/lattice_frame.h"

namespace ofm {

/// What the judge remembers from frame to frame. A value: copies are cheap and independent.
struct MotionState {
  std::optional<LatticeFrame> last;
  cv::Mat belief;  ///< CV_32FC1 per cell of `last`: log-odds of moving
  /// Twist per second of the camera: the motion from this frame's camera to the next one's.
  Vector6d velocity = Vector6d::Zero();
  RigidTransform camera_from_start;  ///< of `last`, by the flow alone: drifts
  DepthMemory memory;
};

/// What is known of a frame before its motion is looked at.
struct MotionInput {
  const LatticeFrame& frame;
  const cv::Mat& flow;     ///< CV_32FC2 per cell: where it was in the last frame, relative [cells]
  const cv::Mat& prior;    ///< CV_32FC1 per cell: log-odds that instances bring along
  std::uint64_t frame_id;  ///< decides the random draws
};

struct MotionVerdict {
  cv::Mat belief;         ///< CV_32FC1 per cell: log-odds of moving
  cv::Mat flow_evidence;  ///< CV_32FC1 per cell: what flow alone says
  CameraMotion camera_motion;
};

/// Joins, cell by cell, what was believed before, what flow says against the camera's motion, what
/// was seen to be free space, and what instances bring along; neighbours then agree. Works with no
/// instance at all. One object serves one thread.
class MotionJudge {
 public:
  MotionJudge(const PinholeCamera& camera, const MotionOptions& options);

  const MotionLattice& lattice() const { return lattice_; }
  /// A function of the input and the state alone. The first frame, and one without flow, begin
  /// anew.
  MotionVerdict Process(const MotionInput& input, MotionState& state) const;

 private:
  cv::Mat JudgeFreeSpace(const LatticeFrame& frame, MotionState& state) const;

  MotionOptions options_;
  MotionLattice lattice_;
};

}  // namespace ofm
