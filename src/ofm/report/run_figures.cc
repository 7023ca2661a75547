#include "ofm/report/run_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "ofm/report/error_figures.h"

namespace ofm {
namespace {

std::string ColorOf(std::size_t run) { return fmt::format("run{}", run); }

/// Names of all runs' stages, the slowest first.
std::vector<std::string> StageNames(const ReportData& data) {
  std::vector<std::pair<double, std::string>> slowest;
  for (const RunView& run : data.runs) {
    if (!run.record.summary) continue;
    for (const StageSummary& stage : run.record.summary->stages) {
      const auto known = std::find_if(slowest.begin(), slowest.end(), [&](const auto& entry) {
        return entry.second == stage.name;
      });
      if (known == slowest.end()) {
        slowest.emplace_back(stage.median_ms, stage.name);
      } else {
        known->first = std::max(known->first, stage.median_ms);
      }
    }
  }
  std::stable_sort(slowest.begin(), slowest.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (auto& [median_ms, name] : slowest) names.push_back(std::move(name));
  return names;
}

BarGroup MakeGroup(const ReportData& data, const std::string& stage_name) {
  BarGroup group{stage_name, {}};
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const auto& summary = data.runs[i].record.summary;
    if (!summary) continue;
    for (const StageSummary& stage : summary->stages) {
      if (stage.name == stage_name) group.bars.push_back({i, stage.median_ms, stage.p99_ms});
    }
  }
  return group;
}

Plot PlotFrameTimes(const ReportData& data) {
  Plot plot;
  plot.title = "CPU time of each frame";
  plot.description = "Sum of the stages that run once a frame; mapping and networks apart.";
  plot.x_label = "time [s]", plot.y_label = "CPU [ms]";
  plot.baseline = PlotBaseline::kZero;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const auto& times = data.runs[i].record.times;
    if (!times || times->stages.empty() || times->stamps_ns.empty()) continue;
    PlotSeries series{data.runs[i].record.name, ColorOf(i), SeriesStyle::kLine, {}};
    for (std::size_t frame = 0; frame < times->stamps_ns.size(); ++frame) {
      double sum_ms = 0;
      for (const std::vector<double>& stage : times->cpu_ms) sum_ms += stage[frame];
      series.points.emplace_back(data.Seconds(times->stamps_ns[frame]), sum_ms);
    }
    series.points = BrokenAtGaps(std::move(series.points));
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

Figure CulledFigure(const ReportData& data) {
  Figure figure;
  Plot plot;
  plot.title = "Culled share of the image";
  plot.x_label = "time [s]", plot.y_label = "masked [% of pixels]";
  plot.baseline = PlotBaseline::kZero;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const RunRecord& record = data.runs[i].record;
    if (!record.frames) {
      figure.missing.push_back(
          record.name +
          ": has no frames.csv, which tells what was culled; run it again with "
          "this version of ofm-slam.");
      continue;
    }
    if (record.frames->empty()) continue;
    PlotSeries series{record.name, ColorOf(i), SeriesStyle::kLine, {}};
    double sum = 0;
    for (const FrameRecord& frame : *record.frames) {
      series.points.emplace_back(data.Seconds(frame.stamp_ns), 100 * frame.masked_share);
      sum += frame.masked_share;
    }
    plot.description +=
        fmt::format("{}{}: {:.1f} % on average", plot.description.empty() ? "" : "; ", record.name,
                    100 * sum / static_cast<double>(record.frames->size()));
    series.points = BrokenAtGaps(std::move(series.points));
    plot.series.push_back(std::move(series));
  }
  if (!plot.series.empty()) figure.plots.push_back(std::move(plot));
  if (figure.empty() && figure.missing.empty()) figure.missing.emplace_back("There is no frame.");
  return figure;
}

Figure TimingFigure(const ReportData& data) {
  Figure figure;
  BarChart bars;
  bars.title = "CPU time by stage";
  bars.description = "Bars are medians, lines reach to the 99th percentile.";
  bars.x_label = "CPU time per call [ms]";
  for (const RunView& run : data.runs) {
    bars.runs.push_back(run.record.name);
    if (!run.record.summary) {
      figure.missing.push_back(run.record.name +
                               ": has no summary.json, which has the times; run it again.");
    }
  }
  for (const std::string& name : StageNames(data)) bars.groups.push_back(MakeGroup(data, name));
  if (!bars.groups.empty()) figure.bars = std::move(bars);
  Plot plot = PlotFrameTimes(data);
  if (!plot.series.empty()) figure.plots.push_back(std::move(plot));
  if (figure.empty() && figure.missing.empty()) figure.missing.emplace_back("No times are known.");
  return figure;
}

}  // namespace ofm
