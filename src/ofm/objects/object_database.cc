#include "ofm/objects/object_database.h"

#include <fmt/format.h>

#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/read_file.h"
#include "ofm/io/sqlite_database.h"

namespace ofm {
namespace {

constexpr std::int64_t kApplicationId = 0x4F464D4F;  // "OFMO"

constexpr const char* kSchema[] = {
    "CREATE TABLE scene (up_x REAL NOT NULL, up_y REAL NOT NULL, up_z REAL NOT NULL)",
    "CREATE TABLE classes (id INTEGER PRIMARY KEY, name TEXT NOT NULL)",
    "CREATE TABLE objects (id INTEGER PRIMARY KEY, "
    "class_id INTEGER NOT NULL REFERENCES classes (id), "
    "x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, "
    "box_x REAL NOT NULL, box_y REAL NOT NULL, box_z REAL NOT NULL, "
    "box_qx REAL NOT NULL, box_qy REAL NOT NULL, box_qz REAL NOT NULL, box_qw REAL NOT NULL, "
    "length_m REAL NOT NULL, width_m REAL NOT NULL, height_m REAL NOT NULL, "
    "first_seen_ns INTEGER NOT NULL, last_seen_ns INTEGER NOT NULL, "
    "views INTEGER NOT NULL, views_expected INTEGER NOT NULL, confidence REAL NOT NULL, "
    "point_count INTEGER NOT NULL, "
    "red INTEGER NOT NULL, green INTEGER NOT NULL, blue INTEGER NOT NULL)",
    "CREATE INDEX objects_by_class ON objects (class_id)",
    "CREATE INDEX objects_by_place ON objects (x, y, z)",
    "CREATE TABLE class_probabilities (object_id INTEGER NOT NULL REFERENCES objects (id), "
    "class_id INTEGER NOT NULL REFERENCES classes (id), probability REAL NOT NULL, "
    "PRIMARY KEY (object_id, class_id)) WITHOUT ROWID",
    "CREATE TABLE tracks (id INTEGER PRIMARY KEY, "
    "class_id INTEGER NOT NULL REFERENCES classes (id), score REAL NOT NULL)",
    "CREATE TABLE track_points (track_id INTEGER NOT NULL REFERENCES tracks (id), "
    "stamp_ns INTEGER NOT NULL, x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, "
    "speed_m_s REAL NOT NULL, PRIMARY KEY (track_id, stamp_ns)) WITHOUT ROWID",
    "CREATE INDEX track_points_by_time ON track_points (stamp_ns)",
    "CREATE VIEW named_objects AS SELECT objects.id, classes.name AS class, x, y, z, "
    "length_m, width_m, height_m, views, confidence "
    "FROM objects JOIN classes ON classes.id = class_id"};

std::int64_t Integer(std::uint32_t value) { return std::int64_t{value}; }

ClassId ReadClass(const SqliteStatement& row, int column, std::size_t classes) {
  const std::int64_t id = row.Integer(column);
  if (id < 0 || id >= static_cast<std::int64_t>(classes)) throw Error("a class has no name");
  return ClassId(static_cast<std::uint32_t>(id));
}

Eigen::Vector3d ReadVector(const SqliteStatement& row, int column) {
  return {row.Real(column), row.Real(column + 1), row.Real(column + 2)};
}

void WriteClasses(SqliteDatabase& database, const ObjectInventory& inventory) {
  const Eigen::Vector3d& up = inventory.up_in_world;
  database.Prepare("INSERT INTO scene VALUES (?, ?, ?)").Run(up.x(), up.y(), up.z());
  SqliteStatement insert = database.Prepare("INSERT INTO classes VALUES (?, ?)");
  for (std::size_t id = 0; id < inventory.class_names.size(); ++id) {
    insert.Run(static_cast<std::int64_t>(id), inventory.class_names[id]);
  }
}

void ReadClasses(const SqliteDatabase& database, ObjectInventory& inventory) {
  SqliteStatement scene = database.Prepare("SELECT up_x, up_y, up_z FROM scene");
  if (!scene.Step()) throw Error("the table scene is empty");
  inventory.up_in_world = ReadVector(scene, 0);
  SqliteStatement row = database.Prepare("SELECT id, name FROM classes ORDER BY id");
  while (row.Step()) {
    if (row.Integer(0) != static_cast<std::int64_t>(inventory.class_names.size())) {
      throw Error("a class is missing");
    }
    inventory.class_names.push_back(row.Text(1));
  }
}

void WriteObjectRows(SqliteDatabase& database, const std::vector<SceneObject>& objects) {
  SqliteStatement insert = database.Prepare(
      "INSERT INTO objects VALUES "
      "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  SqliteStatement probability =
      database.Prepare("INSERT INTO class_probabilities VALUES (?, ?, ?)");
  for (const SceneObject& object : objects) {
    const Eigen::Vector3d &place = object.centroid_in_world, &center = object.box.center_in_world;
    const Eigen::Quaterniond& q = object.box.world_from_box;
    const Eigen::Vector3d& size = object.box.size_m;
    insert.Run(Integer(object.id.value), Integer(object.class_id().value), place.x(), place.y(),
               place.z(), center.x(), center.y(), center.z(), q.x(), q.y(), q.z(), q.w(), size.x(),
               size.y(), size.z(), object.first_seen_ns, object.last_seen_ns,
               std::int64_t{object.views}, std::int64_t{object.views_expected}, object.confidence,
               std::int64_t{object.point_count}, std::int64_t{object.color.r},
               std::int64_t{object.color.g}, std::int64_t{object.color.b});
    for (const ClassProbability& likely : object.classes) {
      probability.Run(Integer(object.id.value), Integer(likely.class_id.value), likely.probability);
    }
  }
}

std::vector<ClassProbability> ReadProbabilities(const SqliteDatabase& database, std::int64_t object,
                                                std::size_t classes) {
  SqliteStatement row = database.Prepare(
      "SELECT class_id, probability FROM class_probabilities WHERE object_id = ? "
      "ORDER BY probability DESC, class_id");
  row.Bind(1, object);
  std::vector<ClassProbability> probabilities;
  while (row.Step()) probabilities.push_back({ReadClass(row, 0, classes), row.Real(1)});
  if (probabilities.empty()) throw Error("an object has no class");
  return probabilities;
}

void ReadObjectRows(const SqliteDatabase& database, ObjectInventory& inventory) {
  SqliteStatement row = database.Prepare("SELECT * FROM objects ORDER BY id");
  while (row.Step()) {
    SceneObject object;
    object.id = ObjectId(static_cast<std::uint32_t>(row.Integer(0)));
    object.classes = ReadProbabilities(database, row.Integer(0), inventory.class_names.size());
    object.centroid_in_world = ReadVector(row, 2);
    object.box.center_in_world = ReadVector(row, 5);
    object.box.world_from_box =
        Eigen::Quaterniond(row.Real(11), row.Real(8), row.Real(9), row.Real(10));
    object.box.size_m = ReadVector(row, 12);
    object.first_seen_ns = row.Integer(15);
    object.last_seen_ns = row.Integer(16);
    object.views = static_cast<int>(row.Integer(17));
    object.views_expected = static_cast<int>(row.Integer(18));
    object.confidence = row.Real(19);
    object.point_count = static_cast<int>(row.Integer(20));
    const auto channel = [&](int i) { return static_cast<std::uint8_t>(row.Integer(21 + i)); };
    object.color = {channel(0), channel(1), channel(2)};
    inventory.objects.push_back(std::move(object));
  }
}

void WriteTrackRows(SqliteDatabase& database, const std::vector<ObjectTrack>& tracks) {
  SqliteStatement insert = database.Prepare("INSERT INTO tracks VALUES (?, ?, ?)");
  SqliteStatement insert_point =
      database.Prepare("INSERT INTO track_points VALUES (?, ?, ?, ?, ?, ?)");
  for (const ObjectTrack& track : tracks) {
    insert.Run(Integer(track.id.value), Integer(track.class_id.value), track.score);
    for (const TrackPoint& point : track.points) {
      const Eigen::Vector3d& place = point.position_in_world;
      insert_point.Run(Integer(track.id.value), point.stamp_ns, place.x(), place.y(), place.z(),
                       point.speed_m_s);
    }
  }
}

void ReadTrackRows(const SqliteDatabase& database, ObjectInventory& inventory) {
  SqliteStatement row = database.Prepare("SELECT id, class_id, score FROM tracks ORDER BY id");
  while (row.Step()) {
    ObjectTrack track{InstanceId(static_cast<std::uint32_t>(row.Integer(0))),
                      ReadClass(row, 1, inventory.class_names.size()),
                      row.Real(2),
                      {}};
    SqliteStatement point = database.Prepare(
        "SELECT stamp_ns, x, y, z, speed_m_s FROM track_points WHERE track_id = ? "
        "ORDER BY stamp_ns");
    point.Bind(1, row.Integer(0));
    while (point.Step()) {
      track.points.push_back({point.Integer(0), ReadVector(point, 1), point.Real(4)});
    }
    inventory.tracks.push_back(std::move(track));
  }
}

std::int64_t ReadPragma(const SqliteDatabase& database, const char* name) {
  SqliteStatement row = database.Prepare(fmt::format("PRAGMA {}", name));
  return row.Step() ? row.Integer(0) : 0;
}

}  // namespace

void SaveObjects(const std::filesystem::path& path, const ObjectInventory& inventory) {
  SqliteDatabase database;
  database.Execute(fmt::format("PRAGMA application_id = {}", kApplicationId));
  database.Execute(fmt::format("PRAGMA user_version = {}", kObjectDatabaseVersion));
  database.Execute("BEGIN");
  for (const char* const statement : kSchema) database.Execute(statement);
  WriteClasses(database, inventory);
  WriteObjectRows(database, inventory.objects);
  WriteTrackRows(database, inventory.tracks);
  database.Execute("COMMIT");
  WriteFileAtomically(path, database.Serialize());
}

ObjectInventory LoadObjects(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  try {
    const SqliteDatabase database(bytes);
    if (ReadPragma(database, "application_id") != kApplicationId) {
      throw Error("it is another program's database");
    }
    const std::int64_t version = ReadPragma(database, "user_version");
    if (version != kObjectDatabaseVersion) {
      throw Error(fmt::format("it is of version {}, and this program reads version {}", version,
                              kObjectDatabaseVersion));
    }
    ObjectInventory inventory;
    ReadClasses(database, inventory);
    ReadObjectRows(database, inventory);
    ReadTrackRows(database, inventory);
    return inventory;
  } catch (const Error& error) {
    throw Error(path, fmt::format("is no object database of ofm-slam: {}", error.what()));
  }
}

}  // namespace ofm
