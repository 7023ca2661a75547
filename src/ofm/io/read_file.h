// Whole files at once.
#pragma once

#include <filesystem>
#include <string>

namespace ofm {

/// The file's bytes. Throws Error where it is missing, is a folder or cannot be read.
std::string ReadFile(const std::filesystem::path& path);

}  // namespace ofm
