#include "ofm/io/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <vector>

#include "ofm/base/check.h"
#include "ofm/base/error.h"

namespace ofm {

struct Sha256::Context {
  EVP_MD_CTX* digest = EVP_MD_CTX_new();
  ~Context() { EVP_MD_CTX_free(digest); }
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  OFM_CHECK(context_->digest != nullptr);
  OFM_CHECK(EVP_DigestInit_ex(context_->digest, EVP_sha256(), nullptr) == 1);
}

Sha256::~Sha256() = default;

void Sha256::Add(std::span<const char> bytes) {
  OFM_CHECK(EVP_DigestUpdate(context_->digest, bytes.data(), bytes.size()) == 1);
}

std::string Sha256::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  OFM_CHECK(EVP_DigestFinal_ex(context_->digest, digest.data(), &size) == 1);
  std::string hexadecimal;
  for (unsigned i = 0; i < size; ++i) hexadecimal += fmt::format("{:02x}", digest[i]);
  return hexadecimal;
}

std::string Sha256OfFile(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw Error(path, "does not exist; check the path");
  if (std::filesystem::is_directory(path)) throw Error(path, "is a folder, not a file");
  std::ifstream file(path, std::ios::binary);
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  do {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.Add({buffer.data(), static_cast<std::size_t>(file.gcount())});
  } while (file);
  if (!file.eof()) throw Error(path, "cannot be read");
  return hash.Finish();
}

std::string ParseSha256(std::string_view text) {
  std::string digits(text);
  std::transform(digits.begin(), digits.end(), digits.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool hexadecimal =
      std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isxdigit(c); });
  if (digits.size() != 64 || !hexadecimal) {
    throw Error(fmt::format("'{}' is no SHA-256; give its 64 hexadecimal digits", text));
  }
  return digits;
}

}  // namespace ofm
