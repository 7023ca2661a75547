// ofm-slam objects: what is in a room, as a run found it.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/objects/object_database.h"
#include "ofm/objects/object_json.h"
#include "ofm/objects/object_query.h"

namespace ofm {
namespace {

constexpr const char* kFooter =
    "RESULTS is the output folder of ofm-slam run with a --segmenter, or its objects.db, an "
    "SQLite\n"
    "database (docs/objects.md). Places are in the world of trajectory.txt [m]; sizes are length "
    "x\n"
    "width x height. \"views\" are the key frames that detected the object, of those that looked "
    "at\n"
    "its place unhidden; the confidence is the mean score over these.\n"
    "Examples:\n"
    "  ofm-slam objects out\n"
    "  ofm-slam objects out --class chair --near 1,2,0\n"
    "  ofm-slam objects out --class tv laptop --min-views 5 --sort confidence\n"
    "  ofm-slam objects out --near 0.5,0,1.2 --radius 1 --json\n"
    "  ofm-slam objects out --tracks";

struct ObjectsArguments {
  std::filesystem::path results;
  std::vector<std::string> classes;
  std::string near, order;
  std::optional<double> radius_m;
  int min_views = 0;
  bool tracks = false, json = false;
};

/// "X,Y,Z" in metres.
Eigen::Vector3d ParsePlace(const std::string& text) {
  Eigen::Vector3d place;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0 && (at == end || *at++ != ',')) break;
    const auto [next, error] = std::from_chars(at, end, place[axis]);
    if (error != std::errc() || !std::isfinite(place[axis])) break;
    at = next;
    if (axis == 2 && at == end) return place;
  }
  throw Error(fmt::format("--near '{}' is no place; write X,Y,Z in metres, as 1,2,0", text));
}

ObjectQuery MakeQuery(const ObjectsArguments& arguments) {
  ObjectQuery query{arguments.classes, {}, arguments.radius_m, arguments.min_views, {}};
  if (!arguments.near.empty()) query.near_in_world = ParsePlace(arguments.near);
  if (query.near_in_world) query.order = ObjectOrder::kDistance;
  if (arguments.order.empty()) return query;
  for (const auto& [order, name] : EnumNames(ObjectOrder())) {
    if (name == arguments.order) query.order = order;
  }
  return query;
}

ObjectInventory Load(const std::filesystem::path& results) {
  if (!std::filesystem::is_directory(results)) return LoadObjects(results);
  const std::filesystem::path path = results / "objects.db";
  if (!std::filesystem::exists(path)) {
    throw Error(path, "does not exist; ofm-slam run writes it where it is given a --segmenter");
  }
  return LoadObjects(path);
}

void PrintObjects(const ObjectAnswer& answer, const std::vector<std::string>& names) {
  if (answer.objects.empty()) return fmt::print("no such object\n");
  const bool with_distance = !answer.distances_m.empty();
  fmt::print("  id  {:<14} {:>5}  {:>8}  {:>5}  {:^23}  {:^18}  {:>6}{}\n", "class", "prob.",
             "views", "conf.", "x, y, z [m]", "size [m]", "points",
             with_distance ? "  away [m]" : "");
  for (std::size_t i = 0; i < answer.objects.size(); ++i) {
    const SceneObject& object = answer.objects[i];
    const Eigen::Vector3d &place = object.centroid_in_world, &size = object.box.size_m;
    fmt::print(
        "{:>4}  {:<14} {:>5.2f}  {:>8}  {:>5.2f}  {:>7.2f} {:>7.2f} {:>7.2f}  "
        "{:>4.2f} x {:>4.2f} x {:>4.2f}  {:>6}",
        object.id.value, names[object.class_id().value], object.classes.front().probability,
        fmt::format("{}/{}", object.views, object.views_expected), object.confidence, place.x(),
        place.y(), place.z(), size.x(), size.y(), size.z(), object.point_count);
    if (with_distance) fmt::print("  {:>8.2f}", answer.distances_m[i]);
    fmt::print("\n");
  }
}

void PrintTracks(const ObjectInventory& inventory) {
  if (inventory.tracks.empty()) return fmt::print("nothing that may move was followed\n");
  fmt::print("  id  {:<14} {:>18}  {:>8}  {:^23}  {:^23}  {:>11}\n", "class", "from [s]", "for [s]",
             "from x, y, z [m]", "to x, y, z [m]", "mean [m/s]");
  for (const ObjectTrack& track : inventory.tracks) {
    const TrackPoint &first = track.points.front(), &last = track.points.back();
    const Eigen::Vector3d &from = first.position_in_world, &to = last.position_in_world;
    double speed = 0;
    for (const TrackPoint& point : track.points) speed += point.speed_m_s;
    fmt::print(
        "{:>4}  {:<14} {:>18}  {:>8.2f}  {:>7.2f} {:>7.2f} {:>7.2f}  "
        "{:>7.2f} {:>7.2f} {:>7.2f}  {:>11.2f}\n",
        track.id.value, inventory.class_names[track.class_id.value], FormatSeconds(first.stamp_ns),
        NanosecondsToSeconds(last.stamp_ns - first.stamp_ns), from.x(), from.y(), from.z(), to.x(),
        to.y(), to.z(), speed / static_cast<double>(track.points.size()));
  }
}

void ListObjects(const ObjectsArguments& arguments) {
  ObjectInventory inventory = Load(arguments.results);
  const ObjectAnswer answer = SelectObjects(inventory, MakeQuery(arguments));
  if (arguments.json) {
    inventory.objects = answer.objects;
    if (!arguments.tracks) inventory.tracks.clear();
    return fmt::print("{}", ObjectsJson(inventory));
  }
  if (arguments.tracks) return PrintTracks(inventory);
  PrintObjects(answer, inventory.class_names);
  if (!inventory.tracks.empty()) {
    fmt::print("and {} tracks of what may move (--tracks)\n", inventory.tracks.size());
  }
}

std::vector<std::string> OrderNames() {
  std::vector<std::string> names;
  for (const auto& [order, name] : EnumNames(ObjectOrder())) names.emplace_back(name);
  return names;
}

}  // namespace

void AddObjectsCommand(CLI::App& app) {
  auto arguments = std::make_shared<ObjectsArguments>();
  CLI::App* command = app.add_subcommand("objects", "List the objects of a room that a run found");
  command->footer(kFooter);
  command->add_option("RESULTS", arguments->results, "Output folder of ofm-slam run")->required();
  command->add_option("--class", arguments->classes, "Only objects of these classes");
  command->add_option("--near", arguments->near, "X,Y,Z [m]: the nearest first");
  command->add_option("--radius", arguments->radius_m, "Only objects so near to it [m]")
      ->check(CLI::PositiveNumber);
  command->add_option("--min-views", arguments->min_views, "Only objects that so many saw")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--sort", arguments->order, "By what; default: distance, or id")
      ->check(CLI::IsMember(OrderNames()));
  command->add_flag("--tracks", arguments->tracks, "List what may move, and where it went");
  command->add_flag("--json", arguments->json, "Print JSON, as in objects.json");
  command->callback([arguments] { ListObjects(*arguments); });
}

}  // namespace ofm
