#include "ofm/io/sqlite_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cstring>

#include "ofm/base/error.h"

namespace ofm {
namespace {

std::unique_ptr<sqlite3, int (*)(sqlite3*)> OpenInMemory() {
  sqlite3* database = nullptr;
  const int result = sqlite3_open(":memory:", &database);
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> owner(database, &sqlite3_close);
  if (result != SQLITE_OK) throw Error(fmt::format("SQLite: {}", sqlite3_errstr(result)));
  return owner;
}

}  // namespace

SqliteStatement::SqliteStatement(sqlite3* database, const std::string& sql)
    : database_(database), statement_(nullptr, &sqlite3_finalize) {
  sqlite3_stmt* statement = nullptr;
  Check(
      sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &statement, nullptr));
  statement_.reset(statement);
}

void SqliteStatement::Bind(int parameter, std::int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), parameter, value));
}

void SqliteStatement::Bind(int parameter, double value) {
  Check(sqlite3_bind_double(statement_.get(), parameter, value));
}

void SqliteStatement::Bind(int parameter, const std::string& text) {
  Check(sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
}

void SqliteStatement::Bind(int parameter, SqliteBlob blob) {
  Check(sqlite3_bind_blob64(statement_.get(), parameter, blob.bytes.data(), blob.bytes.size(),
                            SQLITE_STATIC));
}

bool SqliteStatement::Step() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  Check(result == SQLITE_DONE ? SQLITE_OK : result);
  Check(sqlite3_reset(statement_.get()));
  return false;
}

std::int64_t SqliteStatement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqliteStatement::Real(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::string SqliteStatement::Text(int column) const { return std::string(Blob(column)); }

std::string_view SqliteStatement::Blob(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  if (bytes == nullptr) return {};
  return {static_cast<const char*>(bytes),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

void SqliteStatement::Check(int result) const {
  if (result != SQLITE_OK) throw Error(fmt::format("SQLite: {}", sqlite3_errmsg(database_)));
}

SqliteDatabase::SqliteDatabase() : database_(OpenInMemory()) {}

SqliteDatabase::SqliteDatabase(std::string_view bytes) : database_(OpenInMemory()) {
  // SQLite frees the copy, also where it fails.
  auto* copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
  if (copy == nullptr) throw Error("SQLite: no bytes to read, or not enough memory");
  std::memcpy(copy, bytes.data(), bytes.size());
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  const int result =
      sqlite3_deserialize(database_.get(), "main", copy, size, size,
                          SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
  if (result != SQLITE_OK) throw Error(fmt::format("SQLite: {}", sqlite3_errstr(result)));
  Prepare("SELECT count(*) FROM sqlite_master").Run();  // reads the header
}

SqliteStatement SqliteDatabase::Prepare(const std::string& sql) const {
  return {database_.get(), sql};
}

std::string SqliteDatabase::Serialize() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> bytes(
      sqlite3_serialize(database_.get(), "main", &size, 0), &sqlite3_free);
  if (bytes == nullptr) throw Error("SQLite: not enough memory for a copy of the database");
  return {reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)};
}

}  // namespace ofm
