// Objects in a file; docs/objects.md describes the format.
#pragma once

#include <filesystem>

#include "ofm/objects/scene_object.h"

namespace ofm {

/// Of the format; a file of another one is not read.
inline constexpr int kObjectDatabaseVersion = 1;

/// Writes an SQLite database in one step (WriteFileAtomically). The same inventory gives the same
/// bytes. Throws Error where the file cannot be written.
void SaveObjects(const std::filesystem::path& path, const ObjectInventory& inventory);

/// Throws Error for a file that is missing, is no object database, or is of another version.
ObjectInventory LoadObjects(const std::filesystem::path& path);

}  // namespace ofm
