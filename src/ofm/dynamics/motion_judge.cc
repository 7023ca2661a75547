#include "ofm/dynamics/motion_judge.h"

#include "ofm/base/random.h"
#include "ofm/base/time.h"
#include "ofm/dynamics/flow_evidence.h"
#include "ofm/dynamics/motion_belief.h"

namespace ofm {

MotionJudge::MotionJudge(const PinholeCamera& camera, const MotionOptions& options)
    : options_(options), lattice_(camera, options.lattice) {}

MotionVerdict MotionJudge::Process(const MotionInput& input, MotionState& state) const {
  const LatticeFrame& frame = input.frame;
  MotionVerdict verdict;
  cv::Mat evidence = input.prior + options_.belief.prior_log_odds;
  if (state.last && !input.flow.empty()) {
    const double elapsed_s = NanosecondsToSeconds(frame.stamp_ns - state.last->stamp_ns);
    evidence += CarryBelief(state.belief, *state.last, frame, input.flow, options_.belief);
    const LatticePair pair{frame, *state.last, input.flow, evidence};
    RandomEngine engine = MakeRandomEngine(0, input.frame_id);
    const RigidTransform predicted = ExpSe3(elapsed_s * state.velocity).Inverse();
    verdict.camera_motion =
        EstimateCameraMotion(lattice_.camera(), pair, predicted, options_, engine);
    const RigidTransform& last_from_current = verdict.camera_motion.last_from_current;
    state.velocity = LogSe3(last_from_current.Inverse()) / elapsed_s;
    state.camera_from_start = last_from_current.Inverse() * state.camera_from_start;
    if (verdict.camera_motion.is_contradicted) {
      // Against a motion that is known to be wrong, the whole room would move.
      state.memory = DepthMemory();
    } else {
      verdict.flow_evidence = FlowEvidence(lattice_.camera(), pair, last_from_current, options_);
      evidence += verdict.flow_evidence;
    }
  } else {
    state = MotionState();
  }
  evidence += JudgeFreeSpace(frame, state);
  verdict.belief = RelaxBelief(evidence, frame.depth_m, options_.belief);
  state.last = frame;
  state.belief = verdict.belief;
  return verdict;
}

cv::Mat MotionJudge::JudgeFreeSpace(const LatticeFrame& frame, MotionState& state) const {
  const double delay_s = NanosecondsToSeconds(frame.depth_stamp_ns - frame.stamp_ns);
  const DepthView view = MakeDepthView(
      frame.stamp_ns, ExpSe3(delay_s * state.velocity) * state.camera_from_start, frame.depth_m);
  const auto earlier = state.memory.Select(frame.stamp_ns, options_.free_space);
  cv::Mat evidence = FreeSpaceEvidence(lattice_.camera(), view, earlier, options_.free_space);
  state.memory.Add(view, options_.free_space);
  return evidence;
}

}  // namespace ofm
