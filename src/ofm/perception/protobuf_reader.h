// Walks over a protocol-buffer message without knowing its type.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace ofm {

/// The bytes are no message, or end too early.
struct MalformedMessage {};

/// One field of a message: a number, or bytes (a string or a message within).
struct ProtobufField {
  std::uint64_t number = 0;
  std::uint64_t value = 0;
  std::string_view bytes;
};

/// Gives one field after the other; throws MalformedMessage.
class ProtobufReader {
 public:
  explicit ProtobufReader(std::string_view bytes) : rest_(bytes) {}

  std::optional<ProtobufField> Next();

 private:
  std::uint64_t Varint();
  std::string_view Take(std::uint64_t size);

  std::string_view rest_;
};

/// The last field of that number, as protocol buffers have it; empty where there is none. Throws
/// MalformedMessage.
std::string_view FindProtobufBytes(std::string_view message, std::uint64_t number);

}  // namespace ofm
