// Numbers as little-endian bytes.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>

namespace ofm {

template <std::unsigned_integral T>
void AppendBytes(std::string& bytes, T value) {
  for (std::size_t byte = 0; byte < sizeof(T); ++byte) {
    bytes.push_back(static_cast<char>(value >> 8 * byte & 0xFF));
  }
}

inline void AppendBytes(std::string& bytes, float value) {
  AppendBytes(bytes, std::bit_cast<std::uint32_t>(value));
}

}  // namespace ofm
