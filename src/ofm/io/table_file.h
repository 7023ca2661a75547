// Text files of columns: lists of images, trajectories.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ofm {

/// A text file in memory, split into rows of fields. Fields are separated by blanks, tabs or
/// commas; what follows '#' at the start of a line is a comment; empty lines do not count.
/// Conversions are independent of the locale and throw Error with file and line.
class TableFile {
 public:
  struct Row {
    int line = 0;  ///< from 1
    std::vector<std::string_view> fields;
  };

  /// Throws Error where the file cannot be read.
  explicit TableFile(const std::filesystem::path& path);
  TableFile(const TableFile&) = delete;  // the rows refer to the text
  TableFile& operator=(const TableFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::vector<Row>& rows() const { return rows_; }

  /// Throws Error that names the row.
  [[noreturn]] void Fail(const Row& row, const std::string& message) const;
  /// Throws where the row has not as many fields as `columns` names ("timestamp filename").
  void RequireColumns(const Row& row, std::string_view columns) const;
  /// A finite number.
  double Number(const Row& row, std::size_t field) const;
  /// Seconds, exact to the nanosecond where written as decimals.
  std::int64_t Stamp(const Row& row, std::size_t field) const;

 private:
  std::filesystem::path path_;
  std::string text_;
  std::vector<Row> rows_;
};

/// Checks that times increase from row to row.
class StampOrder {
 public:
  /// Throws Error that names the row where `stamp_ns` does not come after that of the last call.
  void Require(const TableFile& file, const TableFile::Row& row, std::int64_t stamp_ns);

 private:
  std::int64_t last_stamp_ns_ = 0;
  int last_line_ = 0;
};

}  // namespace ofm
