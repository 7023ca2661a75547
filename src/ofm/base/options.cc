#include "ofm/base/options.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>

#include "ofm/base/error.h"

namespace ofm {
namespace {

std::string PlainText(const YAML::Node& node) {
  if (!node.IsScalar()) throw Error("must hold plain values");
  return node.Scalar();
}

// Whether YAML reads `text` back as it stands, also within a list.
bool IsPlain(std::string_view text) {
  const auto is_word = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
           c == '/' || c == '.';
  };
  const auto is_inner = [&](char c) { return is_word(c) || c == ' ' || c == '-' || c == '+'; };
  return !text.empty() && is_word(text.front()) && text.back() != ' ' &&
         std::all_of(text.begin(), text.end(), is_inner) && text != "null" && text != "Null" &&
         text != "NULL";
}

std::string QuoteWhereNeeded(std::string_view text) {
  if (IsPlain(text)) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace

namespace options_internal {

void ParseBool(std::string_view text, bool& value) {
  if (text == "true" || text == "yes" || text == "on" || text == "1") {
    value = true;
  } else if (text == "false" || text == "no" || text == "off" || text == "0") {
    value = false;
  } else {
    throw Error(fmt::format("'{}' is neither true nor false", text));
  }
}

double ParseReal(std::string_view text, Range range) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw Error(fmt::format("'{}' is not a finite number", text));
  }
  if (value < range.min || value > range.max) {
    throw Error(fmt::format("{} is outside [{}, {}]", text, range.min, range.max));
  }
  return value;
}

double ParseWhole(std::string_view text, Range range, Range type_limits) {
  constexpr double kLargestExact = 9007199254740991;  // 2^53 - 1
  const Range valid{std::max({range.min, type_limits.min, -kLargestExact}),
                    std::min({range.max, type_limits.max, kLargestExact})};
  const double value = ParseReal(text, valid);
  if (value != std::floor(value)) throw Error(fmt::format("'{}' is not a whole number", text));
  return value;
}

std::vector<std::string> ParseList(std::string_view text) {
  const bool bracketed = text.starts_with('[');
  std::vector<std::string> items;
  try {
    const YAML::Node list = YAML::Load(bracketed ? std::string(text) : fmt::format("[{}]", text));
    for (const YAML::Node& item : list) items.push_back(PlainText(item));
  } catch (const YAML::Exception&) {
    throw Error(fmt::format("'{}' is not a list; write it as [a, b]", text));
  }
  return items;
}

std::string PrintNumber(float value) { return fmt::format("{}", value); }
std::string PrintNumber(double value) { return fmt::format("{}", value); }

std::string PrintList(std::span<const std::string> items) {
  std::vector<std::string> quoted;
  for (const std::string& item : items) quoted.push_back(QuoteWhereNeeded(item));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string JoinNames(std::span<const std::string_view> names, std::string_view separator) {
  return fmt::format("{}", fmt::join(names, separator));
}

void ThrowBadEnum(std::string_view text, std::string_view type) {
  throw Error(fmt::format("'{}' is none of: {}", text, type));
}

}  // namespace options_internal

namespace {

/// Levenshtein's distance, to suggest the key that was meant.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substitute});
    }
  }
  return row.back();
}

const OptionField& FindField(std::string_view path, const std::vector<OptionField>& fields) {
  const auto same = [&](const OptionField& f) { return f.path == path; };
  const auto found = std::find_if(fields.begin(), fields.end(), same);
  if (found != fields.end()) return *found;
  const auto closer = [&](const OptionField& a, const OptionField& b) {
    return EditDistance(a.path, path) < EditDistance(b.path, path);
  };
  const auto nearest = std::min_element(fields.begin(), fields.end(), closer);
  const std::string hint =
      nearest == fields.end() ? "" : fmt::format("; did you mean '{}'?", nearest->path);
  throw Error(fmt::format("unknown key '{}'{}", path, hint));
}

// A value as OptionField::parse reads it.
std::string ValueText(const YAML::Node& node, const OptionField& field) {
  if (node.IsNull()) return "";
  if (!node.IsSequence()) return PlainText(node);
  if (field.type != "list") throw Error("must be one value, not a list");
  std::vector<std::string> items;
  for (const YAML::Node& item : node) items.push_back(PlainText(item));
  return options_internal::PrintList(items);
}

void LoadValue(const std::string& key, const YAML::Node& value,
               const std::vector<OptionField>& fields) {
  const OptionField& field = FindField(key, fields);
  try {
    field.parse(ValueText(value, field));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", key, error.what()));
  }
}

void LoadGroup(const YAML::Node& group, const std::string& prefix,
               const std::filesystem::path& path, const std::vector<OptionField>& fields) {
  std::set<std::string> seen;
  for (const auto& entry : group) {
    const YAML::Node &name = entry.first, &value = entry.second;
    const int line = name.Mark().line + 1;
    if (!name.IsScalar()) throw Error(path, line, "a key must be plain text");
    const std::string key = prefix + name.Scalar();
    if (!seen.insert(key).second) throw Error(path, line, fmt::format("{}: is given twice", key));
    const bool known = std::any_of(fields.begin(), fields.end(), [&](const OptionField& field) {
      return field.path.starts_with(key + ".");
    });
    if (value.IsMap() && (known || value.size() > 0)) {
      LoadGroup(value, key + ".", path, fields);
    } else if (!known || !value.IsNull()) {  // a known group may be empty
      try {
        LoadValue(key, value, fields);
      } catch (const Error& error) {
        throw Error(path, line, error.what());
      }
    }
  }
}

}  // namespace

void LoadOptionsYaml(const std::filesystem::path& path, const std::vector<OptionField>& fields) {
  if (std::filesystem::is_directory(path)) {
    throw Error(path, "is a directory; name a readable YAML file");
  }
  YAML::Node root;
  try {
    root = YAML::LoadFile(path.string());
  } catch (const YAML::BadFile&) {
    throw Error(path, "cannot be opened; name a readable YAML file");
  } catch (const YAML::Exception& error) {
    throw Error(path, error.mark.line + 1, fmt::format("is not valid YAML: {}", error.msg));
  }
  if (root.IsNull()) return;
  if (!root.IsMap()) throw Error(path, 1, "must hold 'key: value' entries");
  LoadGroup(root, "", path, fields);
}

void ApplyOptionAssignment(std::string_view assignment, const std::vector<OptionField>& fields) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw Error(fmt::format("'{}': write it as key=value, e.g. features.count=1500", assignment));
  }
  try {
    FindField(assignment.substr(0, equals), fields).parse(assignment.substr(equals + 1));
  } catch (const Error& error) {
    throw Error(fmt::format("'{}': {}", assignment, error.what()));
  }
}

std::string PrintOptionsYaml(const std::vector<OptionField>& fields) {
  std::string text;
  std::vector<std::string> open;  // the groups that the previous field was in
  for (const OptionField& field : fields) {
    std::vector<std::string> groups;
    std::string_view rest = field.path;
    for (std::size_t dot; (dot = rest.find('.')) != std::string_view::npos;
         rest.remove_prefix(dot + 1)) {
      groups.emplace_back(rest.substr(0, dot));
    }
    std::size_t shared = 0;
    while (shared < std::min(open.size(), groups.size()) && open[shared] == groups[shared])
      ++shared;
    for (std::size_t i = shared; i < groups.size(); ++i) {
      text += fmt::format("{:{}}{}:\n", "", 2 * i, groups[i]);
    }
    open = groups;
    const std::string value =
        field.type == "text" ? QuoteWhereNeeded(field.print()) : field.print();
    text += fmt::format("{:{}}{}: {}  # {} ({})\n", "", 2 * groups.size(), rest, value, field.doc,
                        field.type);
  }
  return text;
}

}  // namespace ofm
