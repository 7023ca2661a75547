#include "ofm/io/table_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

constexpr std::string_view kSeparators = " \t,\r";

std::vector<std::string_view> SplitFields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(kSeparators), line.size()));
    if (line.empty()) return fields;
    const std::size_t length = std::min(line.find_first_of(kSeparators), line.size());
    fields.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

/// Empty where `text` is not one finite number.
std::optional<double> ParseFinite(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return {};
  return value;
}

/// What of a field may stand in a message: short and printable.
std::string Shown(std::string_view field) {
  std::string shown(field.substr(0, 40));
  for (char& c : shown) {
    if (c < 32 || c > 126) c = '.';
  }
  return field.size() > 40 ? shown + "..." : shown;
}

}  // namespace

TableFile::TableFile(const std::filesystem::path& path) : path_(path), text_(ReadFile(path)) {
  std::string_view rest = text_;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    std::vector<std::string_view> fields = SplitFields(rest.substr(0, length));
    rest.remove_prefix(std::min(length + 1, rest.size()));
    if (!fields.empty() && !fields[0].starts_with('#')) rows_.push_back({line, std::move(fields)});
  }
}

void TableFile::Fail(const Row& row, const std::string& message) const {
  throw Error(path_, row.line, message);
}

void TableFile::RequireColumns(const Row& row, std::string_view columns) const {
  const std::size_t wanted = SplitFields(columns).size();
  if (row.fields.size() == wanted) return;
  Fail(row,
       fmt::format("has {} fields where {} are needed: {}", row.fields.size(), wanted, columns));
}

double TableFile::Number(const Row& row, std::size_t field) const {
  const std::optional<double> value = ParseFinite(row.fields[field]);
  if (!value) {
    Fail(row, fmt::format("'{}' is not a finite number", Shown(row.fields[field])));
  }
  return *value;
}

std::int64_t TableFile::Stamp(const Row& row, std::size_t field) const {
  if (const auto stamp_ns = ParseSeconds(row.fields[field])) return *stamp_ns;
  // Some tools write 1.3050314e+09.
  const std::optional<double> seconds = ParseFinite(row.fields[field]);
  if (!seconds || std::abs(*seconds) > 9e9) {
    Fail(row, fmt::format("'{}' is not a time in seconds", Shown(row.fields[field])));
  }
  return SecondsToNanoseconds(*seconds);
}

void StampOrder::Require(const TableFile& file, const TableFile::Row& row, std::int64_t stamp_ns) {
  if (last_line_ != 0 && stamp_ns <= last_stamp_ns_) {
    file.Fail(row, fmt::format("time {} does not come after {} of line {}; sort by time and "
                               "remove duplicates",
                               FormatSeconds(stamp_ns), FormatSeconds(last_stamp_ns_), last_line_));
  }
  last_stamp_ns_ = stamp_ns;
  last_line_ = row.line;
}

}  // namespace ofm
