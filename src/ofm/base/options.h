// Reflection for option structs: one visitor drives YAML, --set a.b=c, printing and bindings.
//
// An options struct names its fields once, in order:
//
//   struct OrbOptions {
//     int features = 1000;        ///< key points wanted per image
//     double scale_factor = 1.2;  ///< between pyramid levels
//     template <class Self, class Visitor>
//     static void Visit(Self& self, Visitor&& visit) {
//       visit("features", self.features, "key points wanted per image", Range{1, 20000});
//       visit("scale_factor", self.scale_factor, "between pyramid levels", Range{1.01, 2});
//     }
//   };
//
// A field is a bool, an integer, a real, a string, a list of strings, an enum with names
// (EnumNames, found by argument-dependent lookup), or another options struct.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ofm {

/// Inclusive bounds of a number's valid values.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// What EnumNames(E) returns: every value with its name in files and on the command line.
template <class E>
using EnumNameList = std::span<const std::pair<E, std::string_view>>;

/// One scalar field of an options struct, by its dotted path.
struct OptionField {
  std::string path;  ///< e.g. "features.scale_factor"
  std::string doc;   ///< one line, with the unit
  std::string type;  ///< "bool", "int", "real", "text", "list", or "a | b | c"
  std::function<void(std::string_view)> parse;  ///< throws ofm::Error with the reason
  std::function<std::string()> print;           ///< the value as parse() reads it
};

namespace options_internal {

struct AnyVisitor {
  template <class... Ts>
  void operator()(Ts&&...) const {}
};

template <class T>
concept HasVisit = requires(T& t, AnyVisitor v) {
  T::Visit(t, v);
};

void ParseBool(std::string_view text, bool& value);
double ParseReal(std::string_view text, Range range);
/// Whole numbers are kept to what a double, and so every reader of YAML and JSON, holds exactly.
double ParseWhole(std::string_view text, Range range, Range type_limits);
std::vector<std::string> ParseList(std::string_view text);
std::string PrintNumber(float value);
std::string PrintNumber(double value);
std::string PrintList(std::span<const std::string> items);
[[noreturn]] void ThrowBadEnum(std::string_view text, std::string_view type);
std::string JoinNames(std::span<const std::string_view> names, std::string_view separator);

template <class T>
OptionField MakeField(std::string path, T& value, std::string doc, Range range) {
  OptionField field{std::move(path), std::move(doc), {}, {}, {}};
  if constexpr (std::is_same_v<T, bool>) {
    field.type = "bool";
    field.parse = [&value](std::string_view text) { ParseBool(text, value); };
    field.print = [&value] { return std::string(value ? "true" : "false"); };
  } else if constexpr (std::is_enum_v<T>) {
    std::vector<std::string_view> names;
    for (const auto& [v, name] : EnumNames(T{})) names.push_back(name);
    field.type = JoinNames(names, " | ");
    field.parse = [&value, type = field.type](std::string_view text) {
      for (const auto& [v, name] : EnumNames(T{})) {
        if (name == text) return void(value = v);
      }
      ThrowBadEnum(text, type);
    };
    field.print = [&value] {
      for (const auto& [v, name] : EnumNames(T{})) {
        if (v == value) return std::string(name);
      }
      return std::string();
    };
  } else if constexpr (std::is_arithmetic_v<T>) {
    using Limits = std::numeric_limits<T>;
    if constexpr (std::is_integral_v<T>) {
      field.type = "int";
      field.parse = [&value, range](std::string_view text) {
        const Range limits{static_cast<double>(Limits::min()), static_cast<double>(Limits::max())};
        value = static_cast<T>(ParseWhole(text, range, limits));
      };
      field.print = [&value] { return std::to_string(value); };
    } else {
      field.type = "real";
      field.parse = [&value, range](std::string_view text) {
        value = static_cast<T>(ParseReal(text, range));
      };
      field.print = [&value] { return PrintNumber(value); };
    }
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    field.type = "list";
    field.parse = [&value](std::string_view text) { value = ParseList(text); };
    field.print = [&value] { return PrintList(value); };
  } else {
    static_assert(std::is_same_v<T, std::string>, "an option of a type that is not supported");
    field.type = "text";
    field.parse = [&value](std::string_view text) { value = std::string(text); };
    field.print = [&value] { return value; };
  }
  return field;
}

template <class Options>
void Collect(Options& options, const std::string& prefix, std::vector<OptionField>& fields) {
  Options::Visit(options,
                 [&]<class T>(const char* name, T& value, const char* doc = "", Range range = {}) {
                   if constexpr (HasVisit<T>) {
                     Collect(value, prefix + name + ".", fields);
                   } else {
                     fields.push_back(MakeField(prefix + name, value, doc, range));
                   }
                 });
}

}  // namespace options_internal

/// The scalar fields of `options` in declaration order; they refer to it, so it must outlive them.
template <class Options>
std::vector<OptionField> OptionFields(Options& options) {
  std::vector<OptionField> fields;
  options_internal::Collect(options, "", fields);
  return fields;
}

/// Reads a YAML file into the fields. Keys that are absent keep their values; an unknown key, a
/// value of the wrong type or out of range throws Error with path and line.
void LoadOptionsYaml(const std::filesystem::path& path, const std::vector<OptionField>& fields);

/// Applies "a.b=value"; throws Error that names the assignment.
void ApplyOptionAssignment(std::string_view assignment, const std::vector<OptionField>& fields);

/// All fields as YAML that LoadOptionsYaml reads, each with its documentation as a comment.
std::string PrintOptionsYaml(const std::vector<OptionField>& fields);

}  // namespace ofm
