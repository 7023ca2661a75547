// SQLite databases as bytes: made and read in memory, so that others decide how files are written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace ofm {

/// Bytes of a row, NULL where they point to nothing.
struct SqliteBlob {
  std::string_view bytes;  ///< must live until the statement that takes them was run
};

/// A prepared statement; its database must outlive it. Throws Error where SQLite fails.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, const std::string& sql);

  /// Binds the values to the parameters in order, runs the statement to its end and resets it.
  template <class... Values>
  void Run(const Values&... values) {
    int parameter = 0;
    (Bind(++parameter, values), ...);
    while (Step()) {
    }
  }

  void Bind(int parameter, std::int64_t value);
  void Bind(int parameter, double value);
  void Bind(int parameter, const std::string& text);
  void Bind(int parameter, SqliteBlob blob);

  /// Moves on to the next row; false, and ready to be run again, where there is none.
  bool Step();

  // Values of the row, by column from 0, as SQLite converts them.
  std::int64_t Integer(int column) const;
  double Real(int column) const;
  std::string Text(int column) const;
  /// Valid until the next step; points to nothing where the value is NULL or has no byte.
  std::string_view Blob(int column) const;

 private:
  void Check(int result) const;

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
};

/// A database in memory. Serves one thread.
class SqliteDatabase {
 public:
  /// An empty one.
  SqliteDatabase();
  /// A copy of what the bytes of an SQLite file hold. Throws Error where they are none.
  explicit SqliteDatabase(std::string_view bytes);

  void Execute(const std::string& sql) { Prepare(sql).Run(); }
  SqliteStatement Prepare(const std::string& sql) const;
  /// The bytes of an SQLite file; there must be a table.
  std::string Serialize() const;

 private:
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
};

}  // namespace ofm
