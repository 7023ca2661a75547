// Runs and their truth, brought into one world and one time: what plots are made of.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ofm/eval/ate.h"
#include "ofm/eval/rpe.h"
#include "ofm/report/run_record.h"

namespace ofm {

/// Errors of a run against the truth.
struct RunErrors {
  AteResult ate;
  RpeResult rpe_per_frame, rpe_1s;
  std::vector<MotionError> per_frame, over_1s;
};

/// A run in the world of the report: the truth's, where it is known, else the run's own.
struct RunView {
  RunRecord record;
  RigidTransform report_from_run;
  Trajectory trajectory;            ///< report_from_camera
  std::optional<RunErrors> errors;  ///< where there is truth
  std::string why_no_errors;        ///< in one sentence; empty where there are errors
};

/// The plane that a plan shows, seen from above.
struct PlanView {
  Eigen::Vector3d up = {0, 0, 1};
  Eigen::Matrix<double, 2, 3> plan_from_report = Eigen::Matrix<double, 2, 3>::Identity();
  std::string x_label = "x [m]", y_label = "y [m]";

  Eigen::Vector2d operator()(const Eigen::Vector3d& point) const {
    return plan_from_report * point;
  }
};

struct ReportData {
  std::vector<RunView> runs;
  Trajectory truth;  ///< within the runs' time; empty where there is none
  std::filesystem::path truth_file;
  PlanView plan;
  std::int64_t begin_ns = 0;  ///< time 0 of the plots: of the first frame of all runs

  /// Time of the plots [s].
  double Seconds(std::int64_t stamp_ns) const;
};

/// The view along `up` (a unit vector, against gravity, in the report's world). An up that is
/// nearly an axis is taken for it.
PlanView MakePlanView(const Eigen::Vector3d& up);

/// Aligns the runs to the truth and computes their errors. Without `truth_file` the groundtruth.txt
/// in the first run's input folder is taken, where there is one. A run that shares no time with
/// the truth has no errors and says why. Throws Error for a truth that cannot be read.
ReportData MakeReportData(std::vector<RunRecord> records, const std::filesystem::path& truth_file);

}  // namespace ofm
