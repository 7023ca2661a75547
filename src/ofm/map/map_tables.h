// The tables of a map's database (docs/map_file.md).
#pragma once

#include "ofm/io/sqlite_database.h"
#include "ofm/map/map_file.h"

namespace ofm {

/// Makes and fills the tables in an empty database.
void WriteMapTables(SqliteDatabase& database, const MapSnapshot& map, const MapSettings& settings);

/// Throws Error with the reason where the tables are not what WriteMapTables makes.
StoredMap ReadMapTables(const SqliteDatabase& database,
                        std::shared_ptr<const Vocabulary> vocabulary);

}  // namespace ofm
