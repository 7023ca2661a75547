// Folders for what a program writes.
#pragma once

#include <filesystem>

namespace ofm {

/// Makes a folder and those above it; one that is there already is fine. Throws Error that names
/// it and says why it cannot be made.
void MakeFolder(const std::filesystem::path& path);

}  // namespace ofm
