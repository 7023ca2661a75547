#include "ofm/perception/onnx_header.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>

#include "ofm/base/error.h"

namespace ofm {
namespace {

/// Field numbers in onnx.proto3.
constexpr std::uint64_t kModelGraph = 7, kGraphInitializer = 5, kGraphInput = 11, kTensorName = 8,
                        kValueName = 1, kValueType = 2, kTypeTensor = 1, kTensorShape = 2,
                        kShapeDimension = 1, kDimensionValue = 1;

struct Malformed {};

/// One field of a message: a number, or bytes (a string or a message within).
struct Field {
  std::uint64_t number = 0;
  std::uint64_t value = 0;
  std::string_view bytes;
};

/// Walks over the fields of one protocol-buffer message; throws Malformed.
class MessageReader {
 public:
  explicit MessageReader(std::string_view bytes) : rest_(bytes) {}

  std::optional<Field> Next() {
    if (rest_.empty()) return {};
    const std::uint64_t key = Varint();
    Field field;
    field.number = key >> 3;
    if (field.number == 0) throw Malformed();
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
        throw Malformed();
    }
    return field;
  }

 private:
  std::uint64_t Varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<unsigned char>(Take(1).front());
      value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
      if (byte < 0x80) return value;
    }
    throw Malformed();
  }

  std::string_view Take(std::uint64_t size) {
    if (size > rest_.size()) throw Malformed();
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
};

/// The last field of that number, as protocol buffers have it; empty where there is none.
std::string_view FindBytes(std::string_view message, std::uint64_t number) {
  std::string_view found;
  MessageReader reader(message);
  while (const auto field = reader.Next()) {
    if (field->number == number) found = field->bytes;
  }
  return found;
}

OnnxInput ReadInput(std::string_view value_info) {
  OnnxInput input{std::string(FindBytes(value_info, kValueName)), {}};
  const std::string_view tensor = FindBytes(FindBytes(value_info, kValueType), kTypeTensor);
  MessageReader shape(FindBytes(tensor, kTensorShape));
  while (const auto field = shape.Next()) {
    if (field->number != kShapeDimension) continue;
    std::int64_t size = 0;
    MessageReader dimension(field->bytes);
    while (const auto part = dimension.Next()) {
      if (part->number == kDimensionValue) size = static_cast<std::int64_t>(part->value);
    }
    input.shape.push_back(std::max<std::int64_t>(size, 0));
  }
  return input;
}

std::vector<OnnxInput> ReadGraphInputs(std::string_view graph) {
  std::set<std::string, std::less<>> weights;
  std::vector<OnnxInput> inputs;
  MessageReader reader(graph);
  while (const auto field = reader.Next()) {
    if (field->number == kGraphInput) inputs.push_back(ReadInput(field->bytes));
    if (field->number == kGraphInitializer) weights.emplace(FindBytes(field->bytes, kTensorName));
  }
  std::erase_if(inputs, [&](const OnnxInput& input) { return weights.contains(input.name); });
  return inputs;
}

}  // namespace

std::vector<OnnxInput> ReadOnnxInputs(std::span<const char> bytes,
                                      const std::filesystem::path& path) {
  std::vector<OnnxInput> inputs;
  try {
    inputs = ReadGraphInputs(FindBytes({bytes.data(), bytes.size()}, kModelGraph));
  } catch (const Malformed&) {
    throw Error(path, "is no ONNX network or ends too early; export or copy it again");
  }
  if (inputs.empty()) throw Error(path, "is no ONNX network: it has no input; export it again");
  return inputs;
}

}  // namespace ofm
