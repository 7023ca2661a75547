// SHA-256 of bytes as they come (FIPS 180-4), by OpenSSL.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace ofm {

class Sha256 {
 public:
  Sha256();
  ~Sha256();

  void Add(std::span<const char> bytes);
  /// 64 hexadecimal digits, in lower case. Nothing may be added afterwards.
  std::string Finish();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// Throws Error where the file cannot be read.
std::string Sha256OfFile(const std::filesystem::path& path);

/// `text` in lower case. Throws Error where it is no SHA-256.
std::string ParseSha256(std::string_view text);

}  // namespace ofm
