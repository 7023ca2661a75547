#include "ofm/report/html_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "ofm/dense/label_color.h"
#include "ofm/io/read_file.h"
#include "ofm/report/hex_color.h"
#include "ofm/report/map_figure.h"
#include "ofm/report/plot_svg.h"
#include "ofm/report/scene_json.h"
#include "ofm/report/text_encoding.h"

namespace ofm {
namespace {

std::string FigureElement(const std::string& title, const std::string& svg,
                          const std::string& description) {
  std::string text = fmt::format("<figure>\n<h3>{}</h3>\n{}\n", EscapeHtml(title), svg);
  if (!description.empty()) {
    text += fmt::format("<figcaption>{}</figcaption>\n", EscapeHtml(description));
  }
  return text + "</figure>\n";
}

/// What is known of the frame of a picture.
std::string CaptionOf(const ReportData& data, const RunView& run, const KeyframePicture& picture) {
  std::string caption = fmt::format("{:.2f} s", data.Seconds(picture.stamp_ns));
  if (!run.record.frames) return caption;
  const auto& frames = *run.record.frames;
  const auto frame = std::lower_bound(
      frames.begin(), frames.end(), picture.stamp_ns / 1000,
      [](const FrameRecord& f, std::int64_t stamp_us) { return f.stamp_ns / 1000 < stamp_us; });
  if (frame == frames.end() || frame->stamp_ns / 1000 != picture.stamp_ns / 1000) return caption;
  return caption + fmt::format("<br>{:.1f} % masked<br>{} instance{}, {} features",
                               100 * frame->masked_share, frame->instances,
                               frame->instances == 1 ? "" : "s", frame->features);
}

std::string StripOf(const ReportData& data, const RunView& run) {
  std::string text =
      "<div class=\"strip\" tabindex=\"0\" role=\"group\" aria-label=\"key frames\">\n";
  for (const KeyframePicture& picture : run.record.pictures) {
    const std::string bytes = ReadFile(picture.file);
    const std::string base64 =
        EncodeBase64({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
    const std::string caption = CaptionOf(data, run, picture);
    text += fmt::format(
        "<figure><img loading=\"lazy\" src=\"data:image/jpeg;base64,{}\" alt=\"Key frame at {:.2f} "
        "s, what is masked in red\"><figcaption>{}</figcaption></figure>\n",
        base64, data.Seconds(picture.stamp_ns), caption);
  }
  return text + "</div>\n";
}

}  // namespace

std::string SectionHead(const char* anchor, const char* title, const std::string& lead) {
  return fmt::format("<h2 id=\"{}\">{}</h2>\n<p class=\"lead\">{}</p>\n", anchor, title, lead);
}

std::string MissingHtml(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += fmt::format("<p class=\"missing\">{}</p>\n", EscapeHtml(line));
  }
  return text;
}

std::string FigureHtml(const Figure& figure) {
  std::string text;
  if (!figure.empty()) {
    text += "<div class=\"grid-2\">\n";
    if (figure.bars) {
      text += FigureElement(figure.bars->title, PlotToSvg(*figure.bars, SvgUse::kInPage),
                            figure.bars->description);
    }
    for (const Plot& plot : figure.plots) {
      text += FigureElement(plot.title, PlotToSvg(plot, SvgUse::kInPage), plot.description);
    }
    text += "</div>\n";
  }
  return text + MissingHtml(figure.missing);
}

std::string RunNameHtml(std::size_t run, const std::string& name) {
  return fmt::format("<span class=\"run-name run{}\"><span class=\"swatch\"></span>{}</span>", run,
                     EscapeHtml(name));
}

std::string KeyframesHtml(const ReportData& data) {
  std::string text;
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const RunRecord& record = data.runs[i].record;
    if (record.pictures.empty()) {
      missing.push_back(record.name +
                        ": has no pictures of key frames; run it again with --set "
                        "keyframe_images=24.");
      continue;
    }
    text += fmt::format("<p>{}</p>\n{}", RunNameHtml(i, record.name), StripOf(data, data.runs[i]));
  }
  return text + MissingHtml(missing);
}

std::string ViewerHtml(const ReportData& data) {
  std::string text =
      "<figure id=\"viewer\" data-label=\"Interactive view of the map in three dimensions; drag to "
      "turn, scroll to come nearer\">\n"
      "<div class=\"stage\"><noscript>The view needs JavaScript.</noscript></div>\n"
      "<div class=\"switches\"></div>\n"
      "<figcaption>Drag to turn, with the right button or two fingers to move, scroll or pinch to "
      "come nearer.";
  for (const RunView& run : data.runs) {
    const auto& cloud = run.record.cloud;
    if (!cloud || cloud->points.size() == cloud->points_in_file) continue;
    text += fmt::format(" {}: {} of {} points.", EscapeHtml(run.record.name), cloud->points.size(),
                        cloud->points_in_file);
  }
  text += "</figcaption>\n</figure>\n";
  const std::map<int, std::string> classes = ClassesShown(data);
  if (!classes.empty()) {
    text += "<ul class=\"legend-list\" aria-label=\"colours of the classes\">\n";
    for (const auto& [id, name] : classes) {
      text += fmt::format("<li><span class=\"swatch\" style=\"background:{}\"></span>{}</li>\n",
                          HexColor(LabelColor(static_cast<std::uint8_t>(id))), EscapeHtml(name));
    }
    text += fmt::format(
        "<li><span class=\"swatch\" style=\"background:{}\"></span>no class</li>\n</ul>\n",
        HexColor(kUnlabelledColor));
  }
  return text + fmt::format("<script type=\"application/json\" id=\"scene-data\">{}</script>\n",
                            JsonForScript(SceneToJson(data)));
}

}  // namespace ofm
