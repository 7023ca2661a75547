#include "ofm/base/options.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "ofm/base/error.h"

namespace ofm {
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

double ParseNumber(std::string_view text, Range range, bool integer) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw Error(fmt::format("'{}' is not a finite number", text));
  }
  if (integer && value != std::floor(value)) {
    throw Error(fmt::format("'{}' is not a whole number", text));
  }
  if (value < range.min || value > range.max) {
    throw Error(fmt::format("{} is outside [{}, {}]", text, range.min, range.max));
  }
  return value;
}

std::vector<std::string> ParseList(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  std::vector<std::string> items;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    std::string_view item = text.substr(0, comma);
    text.remove_prefix(std::min(comma + 1, text.size()));
    const std::size_t first = item.find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    items.emplace_back(item.substr(first, item.find_last_not_of(" \t") - first + 1));
  }
  return items;
}

std::string PrintNumber(double value) { return fmt::format("{}", value); }

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

std::string ScalarText(const YAML::Node& node) {
  if (!node.IsSequence()) return node.IsNull() ? "" : node.as<std::string>();
  std::vector<std::string> items;
  for (const YAML::Node& item : node) items.push_back(item.as<std::string>());
  return fmt::format("[{}]", fmt::join(items, ", "));
}

void LoadNode(const YAML::Node& node, const std::string& prefix, const std::filesystem::path& path,
              const std::vector<OptionField>& fields) {
  for (const auto& entry : node) {
    const std::string key = prefix + entry.first.as<std::string>();
    if (entry.second.IsMap()) {
      LoadNode(entry.second, key + ".", path, fields);
      continue;
    }
    try {
      FindField(key, fields).parse(ScalarText(entry.second));
    } catch (const std::runtime_error& error) {
      const std::string what = error.what();
      const std::string message =
          what.find(key) == std::string::npos ? fmt::format("{}: {}", key, what) : what;
      throw Error(path, entry.first.Mark().line + 1, message);
    }
  }
}

bool NeedsQuotes(const std::string& value) {
  return value.empty() || value.find_first_of(":#'\"{}&*!|>%@`,\\ ") != std::string::npos;
}

}  // namespace

void LoadOptionsYaml(const std::filesystem::path& path, const std::vector<OptionField>& fields) {
  YAML::Node root;
  try {
    root = YAML::LoadFile(path.string());
  } catch (const YAML::BadFile&) {
    throw Error(path, "cannot be opened; name a readable YAML file");
  } catch (const YAML::ParserException& error) {
    throw Error(path, error.mark.line + 1, fmt::format("is not valid YAML: {}", error.msg));
  }
  if (root.IsNull()) return;
  if (!root.IsMap()) throw Error(path, 1, "must hold 'key: value' entries");
  LoadNode(root, "", path, fields);
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
    std::string value = field.print();
    if (field.type == "text" && NeedsQuotes(value)) {
      std::string quoted = "'";
      for (const char c : value) quoted += c == '\'' ? std::string("''") : std::string(1, c);
      value = quoted + "'";
    }
    text += fmt::format("{:{}}{}: {}  # {} ({})\n", "", 2 * groups.size(), rest, value, field.doc,
                        field.type);
  }
  return text;
}

}  // namespace ofm
