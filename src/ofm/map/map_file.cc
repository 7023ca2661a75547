#include "ofm/map/map_file.h"

#include <fmt/format.h>

#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/read_file.h"
#include "ofm/io/sha256.h"
#include "ofm/map/map_tables.h"

namespace ofm {
namespace {

constexpr std::string_view kMagic("SQLite format 3\0", 16);
constexpr std::uint32_t kApplicationId = 0x4F464D4D;  // "OFMM"
// Where an SQLite file has them, big-endian.
constexpr std::size_t kVersionOffset = 60, kApplicationIdOffset = 68, kHeaderSize = 100;

constexpr std::string_view kSealLabel = "\nofm-map sha256 ";
constexpr std::size_t kSealSize = kSealLabel.size() + 64 + 1;

/// The line that ends the file: the checksum of all before it.
std::string MakeSeal(std::string_view contents) {
  Sha256 hash;
  hash.Add(contents);
  return fmt::format("{}{}\n", kSealLabel, hash.Finish());
}

std::uint32_t ReadBigEndian(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  }
  return value;
}

/// The database in the bytes of a file whose every byte is as it was written.
std::string_view Unseal(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.size() < kHeaderSize || !bytes.starts_with(kMagic) ||
      ReadBigEndian(bytes, kApplicationIdOffset) != kApplicationId) {
    throw Error(path, "is no map of ofm-slam, or its beginning is damaged");
  }
  const std::size_t size = bytes.size() - std::min(bytes.size(), kSealSize);
  const std::string_view contents = bytes.substr(0, size), seal = bytes.substr(size);
  if (!seal.starts_with(kSealLabel)) {
    throw Error(path, "is cut short or was changed: its checksum is missing; use another copy");
  }
  if (seal != MakeSeal(contents)) {
    throw Error(path, "is damaged: its checksum does not match; use another copy");
  }
  return contents;
}

}  // namespace

void SaveMap(const std::filesystem::path& path, const MapSnapshot& map,
             const MapSettings& settings) {
  if (map.keyframe_count == 0) throw Error(path, "is not written: the map has no keyframe");
  SqliteDatabase database;
  database.Execute(fmt::format("PRAGMA application_id = {}", kApplicationId));
  database.Execute(fmt::format("PRAGMA user_version = {}", kMapFileVersion));
  WriteMapTables(database, map, settings);
  std::string bytes = database.Serialize();
  bytes += MakeSeal(bytes);
  WriteFileAtomically(path, bytes);
}

StoredMap LoadMap(const std::filesystem::path& path, std::shared_ptr<const Vocabulary> vocabulary) {
  const std::string bytes = ReadFile(path);
  const std::string_view contents = Unseal(path, bytes);
  const std::uint32_t version = ReadBigEndian(contents, kVersionOffset);
  if (version != kMapFileVersion) {
    throw Error(path, fmt::format("is a map of version {}, but this program reads version {}; make "
                                  "it anew with ofm-slam run --save-map",
                                  version, kMapFileVersion));
  }
  try {
    return ReadMapTables(SqliteDatabase(contents), std::move(vocabulary));
  } catch (const Error& error) {
    throw Error(path, fmt::format("is no map that ofm-slam wrote: {}", error.what()));
  }
}

void RequireSameSettings(const std::filesystem::path& path, MapSettings stored,
                         MapSettings wanted) {
  wanted.camera.depth_scale = stored.camera.depth_scale;  // of the recording, not of the map
  wanted.camera.depth_delay_s = stored.camera.depth_delay_s;
  const std::vector<OptionField> theirs = OptionFields(stored), ours = OptionFields(wanted);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    if (theirs[i].print() == ours[i].print()) continue;
    throw Error(path, fmt::format("was made with {} = {}, but here it is {}; choose the map's {}",
                                  theirs[i].path, theirs[i].print(), ours[i].print(),
                                  theirs[i].path.starts_with("camera.") ? "--camera" : "value"));
  }
}

}  // namespace ofm
