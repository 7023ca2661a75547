// What an ONNX file says about itself, read without loading the network.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace ofm {

/// An input of the network's graph that must be fed (not a weight).
struct OnnxInput {
  std::string name;
  std::vector<std::int64_t> shape;  ///< 0 where a dimension is left open
};

/// The graph's inputs, from the file's bytes (ONNX is a protocol buffer, ModelProto of
/// onnx.proto3). Throws Error that names `path` where the bytes are no ONNX network or end too
/// early.
std::vector<OnnxInput> ReadOnnxInputs(std::span<const char> bytes,
                                      const std::filesystem::path& path);

}  // namespace ofm
