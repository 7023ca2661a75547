// Networks that this program can use: where they are, under which licence, and how to know them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace ofm {

struct KnownModel {
  std::string_view name;
  std::string_view file;
  std::string_view licence;        ///< of the weights
  std::string_view sha256;         ///< in hexadecimal digits; empty where none is published
  std::string_view sha256_source;  ///< who says so
  std::uint64_t bytes;             ///< 0 = not known
  std::string_view address;        ///< of the file, or of the weights that it is made from
  std::string_view make;           ///< how it is made from the weights; empty where it is published
  std::string_view use;            ///< once it is there
};

std::span<const KnownModel> KnownModels();

/// nullptr where there is none.
const KnownModel* FindModelByName(std::string_view name);
const KnownModel* FindModelByFile(std::string_view file);
const KnownModel* FindModelBySha256(std::string_view sha256);

}  // namespace ofm
