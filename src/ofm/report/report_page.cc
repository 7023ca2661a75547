#include "ofm/report/report_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "ofm/base/error.h"
#include "ofm/report/assets.h"
#include "ofm/report/figures.h"
#include "ofm/report/html_parts.h"
#include "ofm/report/text_encoding.h"

namespace ofm {
namespace {

std::string Title(const ReportData& data) {
  std::string names;
  for (const RunView& run : data.runs) names += (names.empty() ? "" : ", ") + run.record.name;
  return names;
}

std::string Head(const ReportData& data) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>ofm-slam: {}</title>\n"
      "<link rel=\"icon\" href=\"data:,\">\n<style>\n{}</style>\n</head>\n<body>\n"
      "<div class=\"page\">\n",
      EscapeHtml(Title(data)), ReportStyle());
}

std::string Header(const ReportData& data) {
  const std::string truth =
      data.truth_file.empty()
          ? "There is no ground truth."
          : fmt::format("Ground truth: <code>{}</code>.", EscapeHtml(data.truth_file.string()));
  return fmt::format(
      "<header>\n<h1>Camera and map: {}</h1>\n<p class=\"lead\">What ofm-slam made of {} run{}. "
      "{}</p>\n"
      "<nav aria-label=\"sections\"><a href=\"#summary\">Summary</a><a "
      "href=\"#trajectory\">Trajectory</a><a href=\"#errors\">Errors</a><a "
      "href=\"#culling\">Culling</a><a href=\"#map\">Map</a><a href=\"#objects\">Objects</a><a "
      "href=\"#timing\">Timing</a></nav>\n</header>\n<main>\n",
      EscapeHtml(Title(data)), data.runs.size(), data.runs.size() == 1 ? "" : "s", truth);
}

std::string TrajectorySection(const ReportData& data) {
  Figure figure = MakeFigure(FigureKind::kPlan, data);
  Figure over_time = MakeFigure(FigureKind::kXyz, data);
  figure.plots.insert(figure.plots.end(), over_time.plots.begin(), over_time.plots.end());
  const bool aligned = std::any_of(data.runs.begin(), data.runs.end(),
                                   [](const RunView& run) { return run.errors.has_value(); });
  return SectionHead(
             "trajectory", "Trajectory",
             aligned ? "Where the camera was, after the best rigid alignment with the ground truth "
                       "(dashed), without scale. Dots mark the beginning."
                     : "Where the camera was, in the world of each run, which is that of its first "
                       "camera. Dots mark the beginning.") +
         FigureHtml(figure);
}

std::string ErrorSection(const ReportData& data) {
  Figure figure = MakeFigure(FigureKind::kAte, data);
  Figure relative = MakeFigure(FigureKind::kRpe, data);
  figure.plots.insert(figure.plots.end(), relative.plots.begin(), relative.plots.end());
  for (const std::string& line : relative.missing) {
    const auto known = std::find(figure.missing.begin(), figure.missing.end(), line);
    if (known == figure.missing.end()) figure.missing.push_back(line);
  }
  return SectionHead(
             "errors", "Errors",
             "ATE: how far each position is from the truth after alignment. RPE: by how much "
             "the motion over a fixed time is off.") +
         FigureHtml(figure);
}

std::string CullingSection(const ReportData& data) {
  return SectionHead(
             "culling", "Culling",
             "What was taken for moving and left out before the pose was computed. Pictures "
             "show key frames, with what is masked in red and instances outlined.") +
         FigureHtml(MakeFigure(FigureKind::kCulled, data)) + KeyframesHtml(data);
}

bool HasScene(const ReportData& data) {
  return std::any_of(data.runs.begin(), data.runs.end(), [](const RunView& run) {
    return run.record.cloud || run.record.voxels || !run.trajectory.empty();
  });
}

std::string MapSection(const ReportData& data) {
  std::string text = SectionHead("map", "Map",
                                 "The static scene: what moved is not in it. Colours by class are "
                                 "those of the legend.");
  if (HasScene(data)) text += ViewerHtml(data);
  return text + FigureHtml(MakeFigure(FigureKind::kMap, data));
}

std::string Footer(const std::string& version) {
  return fmt::format(
      "</main>\n<footer>\n<p>Made by ofm-slam {} (Apache-2.0) with <code>ofm-slam report</code>; "
      "the "
      "plots as files: <code>ofm-slam plot</code>. The 3-D view holds three.js (MIT); its licence "
      "is "
      "in this page's source.</p>\n</footer>\n</div>\n",
      EscapeHtml(version));
}

}  // namespace

ReportData LoadReportData(const std::vector<std::filesystem::path>& folders,
                          const std::filesystem::path& truth_file, const RecordLimits& limits) {
  if (folders.empty()) throw Error("name a folder that ofm-slam run has written");
  if (folders.size() > kMaxRuns) {
    throw Error(fmt::format("a report compares at most {} runs", kMaxRuns));
  }
  const RecordLimits of_each{limits.points / folders.size(), limits.voxels / folders.size()};
  std::vector<RunRecord> records;
  const std::vector<std::string> names = NamesOf(folders);
  for (std::size_t i = 0; i < folders.size(); ++i) {
    records.push_back(LoadRunRecord(folders[i], of_each));
    records.back().name = names[i];
  }
  return MakeReportData(std::move(records), truth_file);
}

std::string ReportPage(const ReportData& data, const std::string& version) {
  std::string page = Head(data) + Header(data);
  page += SectionHead("summary", "Summary",
                      "The main figures; what they mean is said in the sections below.");
  page += SummaryHtml(data);
  page += TrajectorySection(data);
  page += ErrorSection(data);
  page += CullingSection(data);
  page += MapSection(data);
  page += SectionHead("objects", "Objects", "What stands in the room, and what moved through it.");
  page += ObjectsHtml(data);
  page += SectionHead("timing", "Timing", "CPU time, not wall time, of one thread per stage.");
  page += FigureHtml(MakeFigure(FigureKind::kTiming, data));
  page += Footer(version);
  return page + fmt::format("<script>\n{}</script>\n</body>\n</html>\n", ViewerScript());
}

}  // namespace ofm
