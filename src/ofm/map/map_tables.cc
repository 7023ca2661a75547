#include "ofm/map/map_tables.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "ofm/base/error.h"
#include "ofm/features/static_words.h"

namespace ofm {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they are here");

constexpr const char* kSchema[] = {
    "CREATE TABLE settings (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
    "CREATE TABLE keyframes (id INTEGER PRIMARY KEY, stamp_ns INTEGER NOT NULL, "
    "submap INTEGER NOT NULL, qx REAL, qy REAL, qz REAL, qw REAL, tx REAL, ty REAL, tz REAL, "
    "pixels_px BLOB, octaves BLOB, angles_rad BLOB, responses BLOB, descriptors BLOB, "
    "ideal_px BLOB, depths_m BLOB, static_probabilities BLOB, landmarks BLOB)",
    "CREATE TABLE landmarks (id INTEGER PRIMARY KEY, x REAL, y REAL, z REAL, "
    "view_x REAL, view_y REAL, view_z REAL, descriptor BLOB, "
    "min_distance_m REAL, max_distance_m REAL, first_keyframe INTEGER, "
    "visible_count INTEGER, found_count INTEGER, static_probability REAL)",
    "CREATE TABLE replacements (landmark INTEGER PRIMARY KEY, replaced_by INTEGER NOT NULL)",
    "CREATE TABLE anchors (keyframe INTEGER PRIMARY KEY, anchor INTEGER NOT NULL, "
    "qx REAL, qy REAL, qz REAL, qw REAL, tx REAL, ty REAL, tz REAL)"};

/// What is stored beside the settings proper.
struct MapState {
  std::uint32_t keyframe_ids = 0, landmark_ids = 0;  // that were issued
  std::uint32_t latest_keyframe = 0;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("keyframe_ids", self.keyframe_ids, "ids of keyframes that were issued");
    visit("landmark_ids", self.landmark_ids, "ids of landmarks that were issued");
    visit("latest_keyframe", self.latest_keyframe, "id of the keyframe that was made last");
  }
};

std::int64_t Integer(std::uint32_t value) { return std::int64_t{value}; }

template <class T>
SqliteBlob BytesOf(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (values.empty()) return {};
  return {{reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)}};
}

/// The numbers of a blob; throws where there are not `count`.
template <class T>
std::vector<T> NumbersOf(std::string_view blob, std::size_t count) {
  if (blob.size() != count * sizeof(T)) {
    throw Error(
        fmt::format("a list has {} bytes where it needs {}", blob.size(), count * sizeof(T)));
  }
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), blob.data(), blob.size());
  return values;
}

std::vector<float> Flatten(const std::vector<Eigen::Vector2f>& points) {
  std::vector<float> values;
  values.reserve(2 * points.size());
  for (const Eigen::Vector2f& point : points) values.insert(values.end(), {point.x(), point.y()});
  return values;
}

/// A transform in seven columns from `column` on.
RigidTransform ReadTransform(const SqliteStatement& row, int column) {
  const auto real = [&](int i) { return row.Real(column + i); };
  return RigidTransform::FromParts(Eigen::Quaterniond(real(3), real(0), real(1), real(2)),
                                   Eigen::Vector3d(real(4), real(5), real(6)));
}

void WriteSettings(SqliteDatabase& database, const std::vector<OptionField>& fields) {
  SqliteStatement insert = database.Prepare("INSERT INTO settings VALUES (?, ?)");
  for (const OptionField& field : fields) insert.Run(field.path, field.print());
}

void ReadSettings(const SqliteDatabase& database, const std::vector<OptionField>& fields) {
  SqliteStatement select = database.Prepare("SELECT value FROM settings WHERE name = ?");
  for (const OptionField& field : fields) {
    select.Bind(1, field.path);
    if (!select.Step()) throw Error(fmt::format("the setting '{}' is missing", field.path));
    field.parse(select.Text(0));
    while (select.Step()) {
    }
  }
}

void WriteKeyframes(SqliteDatabase& database, const MapSnapshot& map) {
  SqliteStatement insert = database.Prepare(
      "INSERT INTO keyframes VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  map.keyframes.ForEach([&](const Keyframe& keyframe) {
    const FrameFeatures& features = *keyframe.features;
    std::vector<Eigen::Vector2f> pixels;
    std::vector<std::uint8_t> octaves;
    std::vector<float> angles_rad, responses;
    for (const Keypoint& keypoint : features.keypoints) {
      pixels.push_back(keypoint.pixel);
      octaves.push_back(static_cast<std::uint8_t>(keypoint.octave));
      angles_rad.push_back(keypoint.angle_rad);
      responses.push_back(keypoint.response);
    }
    std::vector<std::uint32_t> landmarks;
    for (const LandmarkId id : keyframe.landmarks) landmarks.push_back(id.value);
    const std::vector<float> pixels_px = Flatten(pixels), ideal_px = Flatten(features.ideal_px);
    const Eigen::Quaterniond& q = keyframe.camera_from_world.rotation();
    const Eigen::Vector3d& t = keyframe.camera_from_world.translation();
    insert.Run(Integer(keyframe.id.value), keyframe.stamp_ns, Integer(keyframe.submap.value), q.x(),
               q.y(), q.z(), q.w(), t.x(), t.y(), t.z(), BytesOf(pixels_px), BytesOf(octaves),
               BytesOf(angles_rad), BytesOf(responses), BytesOf(features.descriptors),
               BytesOf(ideal_px), BytesOf(features.depth_m), BytesOf(features.static_probability),
               BytesOf(landmarks));
  });
}

/// The features in the columns from `column` on.
std::shared_ptr<const FrameFeatures> ReadFeatures(const SqliteStatement& row, int column,
                                                  const MapSettings& settings) {
  const auto blob = [&](int i) { return row.Blob(column + i); };
  const std::size_t count = blob(1).size();
  const auto pixels_px = NumbersOf<float>(blob(0), 2 * count);
  const auto octaves = NumbersOf<std::uint8_t>(blob(1), count);
  const auto angles_rad = NumbersOf<float>(blob(2), count);
  const auto responses = NumbersOf<float>(blob(3), count);
  const auto ideal_px = NumbersOf<float>(blob(5), 2 * count);
  auto features = std::make_shared<FrameFeatures>();
  for (std::size_t i = 0; i < count; ++i) {
    if (octaves[i] >= settings.levels) throw Error("a feature is of a level that there is not");
    features->keypoints.push_back({Eigen::Vector2f(pixels_px[2 * i], pixels_px[2 * i + 1]),
                                   octaves[i], angles_rad[i], responses[i]});
    features->ideal_px.emplace_back(ideal_px[2 * i], ideal_px[2 * i + 1]);
  }
  features->descriptors = NumbersOf<Descriptor>(blob(4), count);
  features->depth_m = NumbersOf<float>(blob(6), count);
  if (!blob(7).empty()) features->static_probability = NumbersOf<float>(blob(7), count);
  features->grid = FeatureGrid(features->ideal_px, settings.camera.width, settings.camera.height);
  return features;
}

/// By id, as far as ids were issued.
template <class T>
using Objects = std::vector<std::shared_ptr<T>>;

Objects<Keyframe> ReadKeyframes(const SqliteDatabase& database, const MapSettings& settings,
                                const MapState& state, const Vocabulary& vocabulary) {
  Objects<Keyframe> keyframes(state.keyframe_ids);
  SqliteStatement row = database.Prepare("SELECT * FROM keyframes ORDER BY id");
  while (row.Step()) {
    auto keyframe = std::make_shared<Keyframe>();
    keyframe->id = KeyframeId(static_cast<std::uint32_t>(row.Integer(0)));
    keyframe->stamp_ns = row.Integer(1);
    keyframe->submap = SubmapId(static_cast<std::uint32_t>(row.Integer(2)));
    keyframe->camera_from_world = ReadTransform(row, 3);
    keyframe->features = ReadFeatures(row, 10, settings);
    keyframe->words =
        std::make_shared<const BagOfWords>(StaticWords(*keyframe->features, vocabulary));
    for (const std::uint32_t id :
         NumbersOf<std::uint32_t>(row.Blob(18), keyframe->features->size())) {
      keyframe->landmarks.emplace_back(id);
    }
    if (keyframe->id.value >= keyframes.size()) throw Error("a keyframe's id was never issued");
    if (keyframe->submap.value >= keyframes.size()) throw Error("a sub-map was never begun");
    keyframes[keyframe->id.value] = std::move(keyframe);
  }
  return keyframes;
}

void WriteLandmarks(SqliteDatabase& database, const MapSnapshot& map) {
  SqliteStatement insert =
      database.Prepare("INSERT INTO landmarks VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  map.landmarks.ForEach([&](const Landmark& landmark) {
    const Eigen::Vector3d& point = landmark.position_in_world;
    const Eigen::Vector3d view = landmark.mean_view.cast<double>();
    const std::vector<Descriptor> descriptor{landmark.descriptor};
    insert.Run(Integer(landmark.id.value), point.x(), point.y(), point.z(), view.x(), view.y(),
               view.z(), BytesOf(descriptor), double{landmark.min_distance_m},
               double{landmark.max_distance_m}, Integer(landmark.first_keyframe.value),
               std::int64_t{landmark.visible_count}, std::int64_t{landmark.found_count},
               double{landmark.static_probability});
  });
}

Objects<Landmark> ReadLandmarks(const SqliteDatabase& database, const MapState& state) {
  Objects<Landmark> landmarks(state.landmark_ids);
  SqliteStatement row = database.Prepare("SELECT * FROM landmarks ORDER BY id");
  while (row.Step()) {
    auto landmark = std::make_shared<Landmark>();
    landmark->id = LandmarkId(static_cast<std::uint32_t>(row.Integer(0)));
    landmark->position_in_world = {row.Real(1), row.Real(2), row.Real(3)};
    landmark->mean_view = Eigen::Vector3d(row.Real(4), row.Real(5), row.Real(6)).cast<float>();
    landmark->descriptor = NumbersOf<Descriptor>(row.Blob(7), 1).front();
    landmark->min_distance_m = static_cast<float>(row.Real(8));
    landmark->max_distance_m = static_cast<float>(row.Real(9));
    landmark->first_keyframe = KeyframeId(static_cast<std::uint32_t>(row.Integer(10)));
    landmark->visible_count = static_cast<int>(row.Integer(11));
    landmark->found_count = static_cast<int>(row.Integer(12));
    landmark->static_probability = static_cast<float>(row.Real(13));
    if (landmark->id.value >= landmarks.size()) throw Error("a landmark's id was never issued");
    landmarks[landmark->id.value] = std::move(landmark);
  }
  return landmarks;
}

/// Observations are not stored: they are what the keyframes name.
void AddObservations(const Objects<Keyframe>& keyframes, const Objects<Landmark>& landmarks) {
  for (const auto& keyframe : keyframes) {
    if (!keyframe) continue;
    for (std::size_t i = 0; i < keyframe->landmarks.size(); ++i) {
      const LandmarkId id = keyframe->landmarks[i];
      if (!id.valid()) continue;
      if (id.value >= landmarks.size() || !landmarks[id.value]) {
        throw Error("a keyframe names a landmark that there is not");
      }
      auto& observations = landmarks[id.value]->observations;
      if (!observations.empty() && observations.back().keyframe == keyframe->id) {
        throw Error("a keyframe names a landmark twice");
      }
      if (!observations.empty() &&
          keyframes[observations.front().keyframe.value]->submap != keyframe->submap) {
        throw Error("a landmark is of two sub-maps");
      }
      observations.push_back({keyframe->id, static_cast<int>(i)});
    }
  }
  for (const auto& landmark : landmarks) {
    if (landmark && landmark->observations.empty()) throw Error("no keyframe names a landmark");
  }
}

void WriteHistory(SqliteDatabase& database, const MapSnapshot& map) {
  SqliteStatement replace = database.Prepare("INSERT INTO replacements VALUES (?, ?)");
  for (std::size_t i = 0; i < map.replacements.size(); ++i) {
    if (!map.replacements[i].valid()) continue;
    replace.Run(static_cast<std::int64_t>(i), Integer(map.replacements[i].value));
  }
  SqliteStatement anchor =
      database.Prepare("INSERT INTO anchors VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (const auto& [removed, kept] : map.anchors) {
    const Eigen::Quaterniond& q = kept.removed_from_keyframe.rotation();
    const Eigen::Vector3d& t = kept.removed_from_keyframe.translation();
    anchor.Run(Integer(removed.value), Integer(kept.keyframe.value), q.x(), q.y(), q.z(), q.w(),
               t.x(), t.y(), t.z());
  }
}

void ReadHistory(const SqliteDatabase& database, MapSnapshot& map) {
  map.replacements.resize(map.landmarks.ids_issued());
  SqliteStatement replace = database.Prepare("SELECT * FROM replacements");
  while (replace.Step()) {
    const auto from = static_cast<std::size_t>(replace.Integer(0));
    if (from >= map.replacements.size()) throw Error("a replaced landmark's id was never issued");
    map.replacements[from] = LandmarkId(static_cast<std::uint32_t>(replace.Integer(1)));
  }
  SqliteStatement anchor = database.Prepare("SELECT * FROM anchors");
  while (anchor.Step()) {
    const KeyframeId removed(static_cast<std::uint32_t>(anchor.Integer(0)));
    map.anchors[removed] = {KeyframeId(static_cast<std::uint32_t>(anchor.Integer(1))),
                            ReadTransform(anchor, 2)};
  }
}

template <class T>
std::size_t CountObjects(const Objects<T>& objects) {
  return objects.size() - std::count(objects.begin(), objects.end(), nullptr);
}

}  // namespace

void WriteMapTables(SqliteDatabase& database, const MapSnapshot& map, const MapSettings& settings) {
  database.Execute("BEGIN");
  for (const char* const table : kSchema) database.Execute(table);
  MapSettings printed = settings;
  WriteSettings(database, OptionFields(printed));
  MapState state{static_cast<std::uint32_t>(map.keyframes.ids_issued()),
                 static_cast<std::uint32_t>(map.landmarks.ids_issued()), map.latest_keyframe.value};
  WriteSettings(database, OptionFields(state));
  WriteKeyframes(database, map);
  WriteLandmarks(database, map);
  WriteHistory(database, map);
  database.Execute("COMMIT");
}

StoredMap ReadMapTables(const SqliteDatabase& database,
                        std::shared_ptr<const Vocabulary> vocabulary) {
  StoredMap stored;
  ReadSettings(database, OptionFields(stored.settings));
  MapState state;
  ReadSettings(database, OptionFields(state));
  const Objects<Keyframe> keyframes = ReadKeyframes(database, stored.settings, state, *vocabulary);
  const Objects<Landmark> landmarks = ReadLandmarks(database, state);
  AddObservations(keyframes, landmarks);

  auto map = std::make_shared<MapSnapshot>();
  map->keyframes = TableSnapshot<KeyframeId, Keyframe>({keyframes.begin(), keyframes.end()});
  map->landmarks = TableSnapshot<LandmarkId, Landmark>({landmarks.begin(), landmarks.end()});
  map->keyframe_count = CountObjects(keyframes);
  map->landmark_count = CountObjects(landmarks);
  map->latest_keyframe = KeyframeId(state.latest_keyframe);
  map->vocabulary = std::move(vocabulary);
  ReadHistory(database, *map);
  stored.map = std::move(map);
  return stored;
}

}  // namespace ofm
