#include "ofm/perception/protobuf_reader.h"

namespace ofm {

std::optional<ProtobufField> ProtobufReader::Next() {
  if (rest_.empty()) return {};
  const std::uint64_t key = Varint();
  ProtobufField field;
  field.number = key >> 3;
  if (field.number == 0) throw MalformedMessage();
  switch (key & 7) {
    case 0:
      field.value = Varint();
      break;
    case 1:
      Take(8);
      break;
    case 2:
      field.bytes = Take(Varint());
      break;
    case 5:
      Take(4);
      break;
    default:
      throw MalformedMessage();
  }
  return field;
}

std::uint64_t ProtobufReader::Varint() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    const auto byte = static_cast<unsigned char>(Take(1).front());
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) return value;
  }
  throw MalformedMessage();
}

std::string_view ProtobufReader::Take(std::uint64_t size) {
  if (size > rest_.size()) throw MalformedMessage();
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

std::string_view FindProtobufBytes(std::string_view message, std::uint64_t number) {
  std::string_view found;
  ProtobufReader reader(message);
  while (const auto field = reader.Next()) {
    if (field->number == number) found = field->bytes;
  }
  return found;
}

}  // namespace ofm
