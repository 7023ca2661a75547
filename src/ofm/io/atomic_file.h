// Files that are either the old ones or the new ones, never half of each.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string_view>

namespace ofm {

/// Gives `write` a binary stream and puts what it wrote at `path` in one step: the bytes go to a
/// temporary file in the same folder, to the disk, and are then renamed. Throws Error where a byte
/// cannot be written (no such folder, disk full, ...), and passes on what `write` throws; an older
/// file at `path` is then untouched and the temporary one is gone. A device or pipe at `path`
/// (/dev/stdout) is written directly; of a symbolic link, its target is replaced.
void WriteFileAtomically(const std::filesystem::path& path,
                         const std::function<void(std::ostream&)>& write);

/// The same for contents at hand.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view contents);

/// Throws the Error that WriteFileAtomically would throw for its folder, for those who want to know
/// before they work for long. Leaves nothing, and does not touch a file at `path`.
void RequireWritable(const std::filesystem::path& path);

}  // namespace ofm
