#include "ofm/report/error_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace ofm {
namespace {

constexpr const char* kTimeLabel = "time [s]";
constexpr double kCentimetres = 100;

std::string ColorOf(std::size_t run) { return fmt::format("run{}", run); }

/// A line over time for each run, from `value` of each pose.
template <class Value>
void AddTrajectories(const ReportData& data, Plot& plot, Value&& value) {
  const auto add = [&](const std::string& name, const std::string& color, SeriesStyle style,
                       const Trajectory& trajectory) {
    PlotSeries series{name, color, style, {}};
    for (const auto& [stamp_ns, pose] : trajectory) {
      series.points.emplace_back(data.Seconds(stamp_ns), value(pose.translation()));
    }
    series.points = BrokenAtGaps(std::move(series.points));
    plot.series.push_back(std::move(series));
  };
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const RunView& run = data.runs[i];
    if (!run.trajectory.empty()) {
      add(run.record.name, ColorOf(i), SeriesStyle::kLine, run.trajectory);
    }
  }
  if (!data.truth.empty()) add("ground truth", "truth", SeriesStyle::kDashed, data.truth);
}

/// Lines over time of the runs' errors; runs without are named among what is missing.
template <class Errors, class Value>
Plot PlotErrors(const ReportData& data, Errors&& errors_of, Value&& value) {
  Plot plot;
  plot.x_label = kTimeLabel;
  plot.baseline = PlotBaseline::kZero;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    if (!data.runs[i].errors) continue;
    PlotSeries series{data.runs[i].record.name, ColorOf(i), SeriesStyle::kLine, {}};
    for (const auto& error : errors_of(*data.runs[i].errors)) {
      series.points.emplace_back(data.Seconds(error.stamp_ns), value(error));
    }
    series.points = BrokenAtGaps(std::move(series.points));
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

/// "a: RMSE 1.20 cm, at most 3.40 cm; b: ..."
template <class Statistics>
std::string Describe(const ReportData& data, const char* unit, double scale, Statistics&& get) {
  std::string text;
  for (const RunView& run : data.runs) {
    if (!run.errors) continue;
    const ErrorStatistics& statistics = get(*run.errors);
    text +=
        fmt::format("{}{}: RMSE {:.2f} {}, at most {:.2f} {}", text.empty() ? "" : "; ",
                    run.record.name, scale * statistics.rmse, unit, scale * statistics.max, unit);
  }
  return text;
}

void AddWhyNoErrors(const ReportData& data, Figure& figure) {
  for (const RunView& run : data.runs) {
    if (run.why_no_errors.empty()) continue;
    const std::string line = data.truth_file.empty()
                                 ? run.why_no_errors
                                 : fmt::format("{}: {}", run.record.name, run.why_no_errors);
    if (std::find(figure.missing.begin(), figure.missing.end(), line) == figure.missing.end()) {
      figure.missing.push_back(line);
    }
  }
}

void AddEmptyTrajectories(const ReportData& data, Figure& figure) {
  for (const RunView& run : data.runs) {
    if (!run.trajectory.empty()) continue;
    figure.missing.push_back(run.record.name +
                             ": no frame was tracked, so there is no trajectory to show.");
  }
}

bool HasTrajectory(const ReportData& data) {
  return std::any_of(data.runs.begin(), data.runs.end(),
                     [](const RunView& run) { return !run.trajectory.empty(); });
}

void AddIfNotEmpty(Plot plot, Figure& figure) {
  if (!plot.series.empty()) figure.plots.push_back(std::move(plot));
}

}  // namespace

std::vector<Eigen::Vector2d> BrokenAtGaps(std::vector<Eigen::Vector2d> points) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < points.size(); ++i) {
    intervals.push_back(points[i].x() - points[i - 1].x());
  }
  const double longest = std::max(0.5, 5 * ComputeStatistics(intervals).median);
  std::vector<Eigen::Vector2d> broken;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && points[i].x() - points[i - 1].x() > longest) {
      broken.emplace_back(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
    broken.push_back(points[i]);
  }
  return broken;
}

Figure PlanFigure(const ReportData& data) {
  Figure figure;
  AddEmptyTrajectories(data, figure);
  if (!HasTrajectory(data)) return figure;
  Plot plot;
  plot.title = "Trajectory in plan (from above)";
  plot.description = data.truth.empty() ? "Paths of the camera." : "Paths of the camera, aligned.";
  plot.x_label = data.plan.x_label, plot.y_label = data.plan.y_label;
  plot.shape = PlotShape::kEqualScales;
  const auto add = [&](const std::string& name, const std::string& color, SeriesStyle style,
                       const Trajectory& trajectory) {
    PlotSeries series{name, color, style, {}};
    for (const StampedPose& pose : trajectory) {
      series.points.push_back(data.plan(pose.world_from_camera.translation()));
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  };
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    add(data.runs[i].record.name, ColorOf(i), SeriesStyle::kLine, data.runs[i].trajectory);
  }
  add("ground truth", "truth", SeriesStyle::kDashed, data.truth);
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    if (data.runs[i].trajectory.empty()) continue;
    const Eigen::Vector3d& begin = data.runs[i].trajectory.front().world_from_camera.translation();
    plot.series.push_back({"", ColorOf(i), SeriesStyle::kDots, {data.plan(begin)}});
  }
  figure.plots.push_back(std::move(plot));
  return figure;
}

Figure XyzFigure(const ReportData& data) {
  Figure figure;
  AddEmptyTrajectories(data, figure);
  if (!HasTrajectory(data)) return figure;
  for (int axis = 0; axis < 3; ++axis) {
    Plot plot;
    plot.title = fmt::format("{} over time", "xyz"[axis]);
    plot.description = "The camera's place along one axis.";
    plot.x_label = kTimeLabel;
    plot.y_label = fmt::format("{} [m]", "xyz"[axis]);
    AddTrajectories(data, plot, [&](const Eigen::Vector3d& place) { return place[axis]; });
    figure.plots.push_back(std::move(plot));
  }
  return figure;
}

Figure AteFigure(const ReportData& data) {
  Figure figure;
  Plot plot = PlotErrors(
      data, [](const RunErrors& e) -> const auto& { return e.ate.errors; },
      [](const PositionError& error) { return kCentimetres * error.error_m; });
  plot.title = "Absolute trajectory error (ATE) over time";
  plot.y_label = "ATE [cm]";
  plot.description = Describe(
      data, "cm", kCentimetres,
      [](const RunErrors& e) -> const auto& { return e.ate.translation_m; });
  AddIfNotEmpty(std::move(plot), figure);
  AddWhyNoErrors(data, figure);
  return figure;
}

Figure RpeFigure(const ReportData& data) {
  Figure figure;
  const auto over_1s = [](const RunErrors& e) -> const auto& { return e.over_1s; };
  const auto per_frame = [](const RunErrors& e) -> const auto& { return e.per_frame; };
  const auto translation_cm = [](const MotionError& e) { return kCentimetres * e.translation_m; };
  Plot plot = PlotErrors(data, over_1s, translation_cm);
  plot.title = "Relative pose error (RPE) over 1 s: translation";
  plot.y_label = "RPE [cm]";
  plot.description = Describe(
      data, "cm", kCentimetres,
      [](const RunErrors& e) -> const auto& { return e.rpe_1s.translation_m; });
  AddIfNotEmpty(std::move(plot), figure);
  plot = PlotErrors(data, over_1s, [](const MotionError& e) { return e.rotation_deg; });
  plot.title = "RPE over 1 s: rotation";
  plot.y_label = "RPE [degrees]";
  plot.description = Describe(
      data, "degrees", 1, [](const RunErrors& e) -> const auto& { return e.rpe_1s.rotation_deg; });
  AddIfNotEmpty(std::move(plot), figure);
  plot = PlotErrors(data, per_frame, translation_cm);
  plot.title = "RPE from frame to frame: translation";
  plot.y_label = "RPE [cm]";
  plot.description = Describe(
      data, "cm", kCentimetres,
      [](const RunErrors& e) -> const auto& { return e.rpe_per_frame.translation_m; });
  AddIfNotEmpty(std::move(plot), figure);
  AddWhyNoErrors(data, figure);
  if (figure.empty() && figure.missing.empty()) {
    figure.missing.emplace_back("There are too few poses for an RPE.");
  }
  return figure;
}

}  // namespace ofm
