#include "ofm/report/report_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/trajectory_file.h"

namespace ofm {
namespace {

std::filesystem::path FindTruth(const std::vector<RunRecord>& records) {
  for (const RunRecord& record : records) {
    if (!record.summary || record.summary->input.empty()) continue;
    const auto file = std::filesystem::path(record.summary->input) / "groundtruth.txt";
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return {};
}

/// What is between the first and the last pose of all runs.
Trajectory WithinRuns(const Trajectory& truth, const std::vector<RunRecord>& records) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = std::numeric_limits<std::int64_t>::min();
  for (const RunRecord& record : records) {
    if (record.trajectory.empty()) continue;
    first = std::min(first, record.trajectory.front().stamp_ns);
    last = std::max(last, record.trajectory.back().stamp_ns);
  }
  Trajectory within;
  std::copy_if(truth.begin(), truth.end(), std::back_inserter(within),
               [&](const auto& pose) { return pose.stamp_ns >= first && pose.stamp_ns <= last; });
  return within;
}

RunErrors ComputeErrors(const Trajectory& estimate, const Trajectory& truth) {
  const RpeOptions per_frame = {.pairs = RpePairs::kConsecutive}, over_1s = {};
  return {ComputeAte(estimate, truth), ComputeRpe(estimate, truth, per_frame),
          ComputeRpe(estimate, truth, over_1s), ComputeMotionErrors(estimate, truth, per_frame),
          ComputeMotionErrors(estimate, truth, over_1s)};
}

RunView MakeView(RunRecord record, const Trajectory& truth) {
  RunView view;
  view.record = std::move(record);
  view.trajectory = view.record.trajectory;
  if (truth.empty()) {
    view.why_no_errors =
        "There is no ground truth: name its file by --ground-truth (lines 'timestamp tx ty tz qx "
        "qy qz qw').";
    return view;
  }
  try {
    view.errors = ComputeErrors(view.trajectory, truth);
    view.report_from_run = view.errors->ate.truth_from_estimate;
    view.trajectory = view.errors->ate.aligned_estimate;
  } catch (const Error& error) {
    view.why_no_errors = fmt::format("No errors against the ground truth: {}.", error.what());
  }
  return view;
}

/// Against gravity, as far as the run tells: its objects' boxes stand on it, and cameras are held
/// upright on average.
Eigen::Vector3d UpOf(const RunView& run) {
  if (run.record.objects) {
    return run.report_from_run.rotation() * run.record.objects->up_in_world;
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const StampedPose& pose : run.trajectory) {
    sum -= pose.world_from_camera.RotationMatrix().col(1);
  }
  return sum.norm() > 1e-6 ? Eigen::Vector3d(sum.normalized())
                           : Eigen::Vector3d(-Eigen::Vector3d::UnitY());
}

/// Makers of ground truth level their worlds: the axis next to `up` is the right one.
Eigen::Vector3d NearestAxis(const Eigen::Vector3d& up) {
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  return std::copysign(1., up[axis]) * Eigen::Vector3d::Unit(axis);
}

std::int64_t FirstStamp(const std::vector<RunView>& runs) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  for (const RunView& run : runs) {
    const auto& frames = run.record.frames;
    if (frames && !frames->empty()) first = std::min(first, frames->front().stamp_ns);
    if (!run.trajectory.empty()) first = std::min(first, run.trajectory.front().stamp_ns);
  }
  return first == std::numeric_limits<std::int64_t>::max() ? 0 : first;
}

}  // namespace

double ReportData::Seconds(std::int64_t stamp_ns) const {
  return NanosecondsToSeconds(stamp_ns - begin_ns);
}

PlanView MakePlanView(const Eigen::Vector3d& up) {
  PlanView view;
  const Eigen::Vector3d axis = NearestAxis(up);
  const bool is_axis = up.dot(axis) > std::cos(1e-3);
  view.up = is_axis ? axis : up;
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  if (std::abs(view.up.x()) > 0.9) right = Eigen::Vector3d::UnitY();
  right = (right - right.dot(view.up) * view.up).normalized();
  const Eigen::Vector3d ahead = view.up.cross(right);
  view.plan_from_report << right.transpose(), ahead.transpose();
  if (!is_axis) {
    view.x_label = "right [m]", view.y_label = "ahead [m]";
    return view;
  }
  const auto label = [](const Eigen::Vector3d& direction) {
    Eigen::Index index = 0;
    direction.cwiseAbs().maxCoeff(&index);
    return fmt::format("{}{} [m]", direction[index] < 0 ? "-" : "", "xyz"[index]);
  };
  view.x_label = label(right), view.y_label = label(ahead);
  return view;
}

ReportData MakeReportData(std::vector<RunRecord> records, const std::filesystem::path& truth_file) {
  ReportData data;
  data.truth_file = truth_file.empty() ? FindTruth(records) : truth_file;
  Trajectory truth;
  if (!data.truth_file.empty()) {
    truth = LoadTrajectory(data.truth_file);
    if (truth.size() < 2) throw Error(data.truth_file, "holds fewer than 2 poses");
    data.truth = WithinRuns(truth, records);
  }
  for (RunRecord& record : records) data.runs.push_back(MakeView(std::move(record), truth));
  data.begin_ns = FirstStamp(data.runs);
  if (!data.runs.empty()) {
    const Eigen::Vector3d up = UpOf(data.runs.front());
    data.plan = MakePlanView(data.runs.front().errors ? NearestAxis(up) : up);
  }
  return data;
}

}  // namespace ofm
