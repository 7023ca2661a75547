// The list of objects, and of what moved.
#include <fmt/format.h>

#include <algorithm>

#include "ofm/dense/label_color.h"
#include "ofm/report/hex_color.h"
#include "ofm/report/html_parts.h"
#include "ofm/report/text_encoding.h"

namespace ofm {
namespace {

constexpr std::size_t kMostRows = 200;

std::string ClassCell(const ObjectInventory& inventory, ClassId id) {
  const std::string name =
      id.value < inventory.class_names.size() ? inventory.class_names[id.value] : "?";
  return fmt::format(
      "<td class=\"text\"><span class=\"swatch\" style=\"background:{}\"></span>{}</td>",
      HexColor(LabelColor(static_cast<std::uint8_t>(std::min(id.value, 255U)))), EscapeHtml(name));
}

std::string ObjectRow(const ObjectInventory& inventory, const SceneObject& object) {
  const Eigen::Vector3d& place = object.box.center_in_world;
  const Eigen::Vector3d& size = object.box.size_m;
  return fmt::format(
      "<tr><td>{}</td>{}<td>{:.0f} %</td><td>{:.2f}</td><td>{}/{}</td><td>{:.2f}, {:.2f}, "
      "{:.2f}</td><td>{:.2f} × {:.2f} × {:.2f}</td></tr>\n",
      object.id.value, ClassCell(inventory, object.class_id()),
      object.classes.empty() ? 0. : 100 * object.classes.front().probability, object.confidence,
      object.views, object.views_expected, place.x(), place.y(), place.z(), size.x(), size.y(),
      size.z());
}

std::string TrackRow(const ReportData& data, const ObjectInventory& inventory,
                     const ObjectTrack& track) {
  double path_m = 0;
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    path_m += (track.points[i].position_in_world - track.points[i - 1].position_in_world).norm();
  }
  const double begin_s = data.Seconds(track.points.front().stamp_ns);
  const double end_s = data.Seconds(track.points.back().stamp_ns);
  return fmt::format(
      "<tr><td>{}</td>{}<td>{:.1f} to {:.1f}</td><td>{}</td><td>{:.2f}</td><td>{}</td></tr>\n",
      track.id.value, ClassCell(inventory, track.class_id), begin_s, end_s, track.points.size(),
      path_m, end_s > begin_s ? fmt::format("{:.2f}", path_m / (end_s - begin_s)) : "–");
}

/// Rows of a table, of which not more than kMostRows are shown.
template <class Items, class MakeRow>
std::string TableOf(const std::string& caption, const char* head, const Items& items,
                    MakeRow&& make_row) {
  std::string text = fmt::format(
      "<div class=\"table\"><table>\n<caption>{}</caption>\n<thead><tr>{}</tr></thead>\n<tbody>\n",
      caption, head);
  std::size_t rows = 0;
  for (const auto& item : items) {
    if (rows++ == kMostRows) break;
    text += make_row(item);
  }
  text += "</tbody>\n</table></div>\n";
  if (items.size() > kMostRows) {
    text += fmt::format("<p class=\"note\">The first {} of {}; all are in objects.json.</p>\n",
                        kMostRows, items.size());
  }
  return text;
}

std::string ObjectsOf(const ReportData& data, std::size_t index) {
  const RunRecord& record = data.runs[index].record;
  const ObjectInventory& inventory = *record.objects;
  std::string text;
  if (inventory.objects.empty()) {
    text += MissingHtml({record.name + ": no object was found."});
  } else {
    text += TableOf(
        fmt::format("{}: objects that stand still, in the run's own world",
                    RunNameHtml(index, record.name)),
        "<th>id</th><th class=\"text\">class</th><th>probability</th><th>confidence</th>"
        "<th>views</th><th>centre x, y, z [m]</th><th>size [m]</th>",
        inventory.objects, [&](const SceneObject& object) { return ObjectRow(inventory, object); });
  }
  std::vector<ObjectTrack> tracks;
  for (const ObjectTrack& track : inventory.tracks) {
    if (!track.points.empty()) tracks.push_back(track);
  }
  if (tracks.empty()) return text;
  return text + TableOf(fmt::format("{}: tracks of what may move", RunNameHtml(index, record.name)),
                        "<th>id</th><th class=\"text\">class</th><th>time [s]</th><th>frames</th>"
                        "<th>path [m]</th><th>mean speed [m/s]</th>",
                        tracks,
                        [&](const ObjectTrack& track) { return TrackRow(data, inventory, track); });
}

}  // namespace

std::string ObjectsHtml(const ReportData& data) {
  std::string text;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const RunRecord& record = data.runs[i].record;
    if (record.objects) {
      text += ObjectsOf(data, i);
    } else {
      text += MissingHtml(
          {record.name + ": has no objects.db; run with a --segmenter to find objects."});
    }
  }
  return text;
}

}  // namespace ofm
