#include "ofm/report/text_encoding.h"

#include <openssl/evp.h>

#include <nlohmann/json.hpp>

#include "ofm/base/check.h"

namespace ofm {

std::string EscapeHtml(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default: {
        const auto byte = static_cast<unsigned char>(c);
        const bool forbidden = (byte < ' ' && c != '\n' && c != '\t') || byte == 127;
        forbidden ? escaped += "\xEF\xBF\xBD" : escaped += c;
      }
    }
  }
  return escaped;
}

std::string EncodeBase64(std::span<const unsigned char> bytes) {
  // EVP_EncodeBlock also writes a zero behind the text.
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(),
                                     static_cast<int>(bytes.size()));
  OFM_CHECK(length >= 0);
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string JsonForScript(const nlohmann::ordered_json& json) {
  const std::string text =
      json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

}  // namespace ofm
