// Text and bytes as HTML takes them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace ofm {

/// `text` for between tags and within quoted attributes: & < > " ' become references; control
/// characters, which HTML forbids, become U+FFFD.
std::string EscapeHtml(std::string_view text);

/// RFC 4648, padded, without line breaks.
std::string EncodeBase64(std::span<const unsigned char> bytes);

/// JSON in ASCII that can stand within a script element: no '<'. What is no UTF-8 becomes U+FFFD.
std::string JsonForScript(const nlohmann::ordered_json& json);

}  // namespace ofm
