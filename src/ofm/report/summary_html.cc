// The first section of a report: cards and the table of all runs.
#include <fmt/format.h>

#include <functional>
#include <limits>

#include "ofm/report/html_parts.h"
#include "ofm/report/text_encoding.h"

namespace ofm {
namespace {

/// A figure of a run, where it is known.
using Value = std::optional<double>;

/// The ATE [m], measured for this report or else by the run itself.
Value AteOf(const RunView& run) {
  if (run.errors) return run.errors->ate.translation_m.rmse;
  return run.record.summary ? run.record.summary->ate_rmse_m : Value();
}

Value TrackedShare(const RunView& run) {
  const auto& summary = run.record.summary;
  if (!summary || summary->frames == 0) return {};
  return static_cast<double>(summary->frames_tracked) / static_cast<double>(summary->frames);
}

Value FramesPerSecond(const RunView& run) {
  const auto& summary = run.record.summary;
  if (!summary || summary->wall_s <= 0) return {};
  return static_cast<double>(summary->frames) / summary->wall_s;
}

std::string CardEntry(const char* name, const std::string& value) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
}

std::string Card(std::size_t index, const RunView& run) {
  std::string text = fmt::format("<div class=\"card run{}\">\n<h3>{}</h3>\n", index,
                                 RunNameHtml(index, run.record.name));
  const Value ate = AteOf(run);
  if (ate) {
    text += fmt::format(
        "<div class=\"big\">{:.2f}<span class=\"unit\">cm</span></div>\n"
        "<div class=\"note\">ATE, RMSE</div>\n",
        100 * *ate);
  } else {
    text += fmt::format(
        "<div class=\"big\">{}<span class=\"unit\">poses</span></div>\n"
        "<div class=\"note\">tracked; no ground truth to compare with</div>\n",
        run.trajectory.size());
  }
  text += "<dl>\n";
  if (const Value share = TrackedShare(run)) {
    text += CardEntry("frames tracked", fmt::format("{:.1f} %", 100 * *share));
  }
  if (run.record.summary) {
    text += CardEntry("pixels culled",
                      fmt::format("{:.1f} %", 100 * run.record.summary->mean_masked_share));
  }
  if (const Value speed = FramesPerSecond(run)) {
    text += CardEntry("speed", fmt::format("{:.1f} frames/s", *speed));
  }
  return text + "</dl>\n</div>\n";
}

enum class Better { kNeither, kLess };

/// A row of the table.
struct Row {
  const char* title;
  std::function<Value(const RunView&)> get;
  const char* format;
  Better better = Better::kNeither;
};

/// Of summary.json, where there is one.
template <class Get>
std::function<Value(const RunView&)> FromSummary(Get get) {
  return [get](const RunView& run) {
    return run.record.summary ? Value(static_cast<double>(get(*run.record.summary))) : Value();
  };
}

/// Of the errors against the truth, where there is one.
template <class Get>
std::function<Value(const RunView&)> FromErrors(double scale, Get get) {
  return [get, scale](const RunView& run) {
    return run.errors ? Value(scale * get(*run.errors)) : Value();
  };
}

std::vector<Row> Rows() {
  return {
      {"ATE RMSE [cm]",
       [](const RunView& run) -> Value {
         const Value ate = AteOf(run);
         return ate ? Value(100 * *ate) : Value();
       },
       "{:.2f}", Better::kLess},
      {"ATE median [cm]",
       FromErrors(100, [](const RunErrors& e) { return e.ate.translation_m.median; }), "{:.2f}",
       Better::kLess},
      {"ATE maximum [cm]",
       FromErrors(100, [](const RunErrors& e) { return e.ate.translation_m.max; }), "{:.2f}",
       Better::kLess},
      {"RPE over 1 s, RMSE [cm]",
       FromErrors(100, [](const RunErrors& e) { return e.rpe_1s.translation_m.rmse; }), "{:.2f}",
       Better::kLess},
      {"RPE over 1 s, RMSE [degrees]",
       FromErrors(1, [](const RunErrors& e) { return e.rpe_1s.rotation_deg.rmse; }), "{:.2f}",
       Better::kLess},
      {"RPE per frame, RMSE [cm]",
       FromErrors(100, [](const RunErrors& e) { return e.rpe_per_frame.translation_m.rmse; }),
       "{:.2f}", Better::kLess},
      {"frames", FromSummary([](const RunSummary& s) { return s.frames; }), "{:.0f}"},
      {"frames tracked", FromSummary([](const RunSummary& s) { return s.frames_tracked; }),
       "{:.0f}"},
      {"times lost", FromSummary([](const RunSummary& s) { return s.losses; }), "{:.0f}"},
      {"loops closed", FromSummary([](const RunSummary& s) { return s.loops_closed; }), "{:.0f}"},
      {"pixels culled, mean [%]",
       FromSummary([](const RunSummary& s) { return 100 * s.mean_masked_share; }), "{:.1f}"},
      {"key frames", FromSummary([](const RunSummary& s) { return s.keyframes; }), "{:.0f}"},
      {"landmarks", FromSummary([](const RunSummary& s) { return s.landmarks; }), "{:.0f}"},
      {"cloud points",
       [](const RunView& run) -> Value {
         const auto& cloud = run.record.cloud;
         return cloud ? Value(static_cast<double>(cloud->points_in_file)) : Value();
       },
       "{:.0f}"},
      {"objects",
       [](const RunView& run) -> Value {
         const auto& objects = run.record.objects;
         return objects ? Value(static_cast<double>(objects->objects.size())) : Value();
       },
       "{:.0f}"},
      {"wall time [s]", FromSummary([](const RunSummary& s) { return s.wall_s; }), "{:.1f}"},
      {"CPU per frame [ms]",
       [](const RunView& run) -> Value {
         const auto& summary = run.record.summary;
         if (!summary || summary->frames == 0) return {};
         return 1e3 * summary->process_cpu_s / static_cast<double>(summary->frames);
       },
       "{:.1f}"},
      {"peak memory [MiB]", FromSummary([](const RunSummary& s) { return s.peak_memory_mib; }),
       "{:.0f}"},
  };
}

/// A row's cells; empty where no run knows the figure.
std::string RowHtml(const ReportData& data, const Row& row) {
  double best = std::numeric_limits<double>::infinity();
  std::size_t known = 0;
  for (const RunView& run : data.runs) {
    const Value value = row.get(run);
    if (!value) continue;
    ++known;
    best = std::min(best, *value);
  }
  if (known == 0) return {};
  std::string text = fmt::format("<tr><th scope=\"row\">{}</th>", row.title);
  for (const RunView& run : data.runs) {
    const Value value = row.get(run);
    const bool is_best = value && row.better == Better::kLess && known > 1 && *value == best;
    text += fmt::format("<td{}>{}</td>", is_best ? " class=\"best\"" : "",
                        value ? fmt::format(fmt::runtime(row.format), *value) : "–");
  }
  return text + "</tr>\n";
}

std::string TextRow(const ReportData& data, const char* title,
                    const std::function<std::string(const RunSummary&)>& get) {
  std::string text = fmt::format("<tr><th scope=\"row\">{}</th>", title);
  for (const RunView& run : data.runs) {
    const auto& summary = run.record.summary;
    text += fmt::format("<td>{}</td>", summary ? EscapeHtml(get(*summary)) : "–");
  }
  return text + "</tr>\n";
}

std::string Table(const ReportData& data) {
  std::string text = "<div class=\"table\"><table>\n<caption>";
  text += data.runs.size() > 1 ? "All runs side by side; the least error of each row is bold."
                               : "All figures of the run.";
  text += "</caption>\n<thead><tr><th scope=\"col\"></th>";
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    text += fmt::format("<th scope=\"col\">{}</th>", RunNameHtml(i, data.runs[i].record.name));
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const Row& row : Rows()) text += RowHtml(data, row);
  text += TextRow(data, "input", [](const RunSummary& s) { return s.input; });
  text += TextRow(data, "runner, seed",
                  [](const RunSummary& s) { return fmt::format("{}, {}", s.runner, s.seed); });
  text += TextRow(data, "version", [](const RunSummary& s) { return s.version; });
  return text + "</tbody>\n</table></div>\n";
}

}  // namespace

std::string SummaryHtml(const ReportData& data) {
  std::string text = "<div class=\"cards\">\n";
  for (std::size_t i = 0; i < data.runs.size(); ++i) text += Card(i, data.runs[i]);
  text += "</div>\n";
  for (const RunView& run : data.runs) {
    if (!run.record.summary) {
      text += MissingHtml({run.record.name +
                           ": has no summary.json, which has its counts and times; run it again."});
      continue;
    }
    if (run.record.summary->error.empty()) continue;
    text += fmt::format("<p class=\"missing error\">{} ended early: {}</p>\n",
                        EscapeHtml(run.record.name), EscapeHtml(run.record.summary->error));
  }
  return text + Table(data);
}

}  // namespace ofm
