// Names of the classes that networks tell apart.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ofm/base/ids.h"

namespace ofm {

/// Most classes that a list may have: 255 means "no label" in label images.
inline constexpr std::size_t kMaxClasses = 255;

/// The 80 classes of the COCO detection task (Lin et al., ECCV 2014), in the order of their ids.
const std::vector<std::string>& CocoClassNames();

/// Reads one name a line; blank lines at the end are dropped. Throws Error for a file that cannot
/// be read, an empty or repeated name, no name at all, or more than kMaxClasses.
std::vector<std::string> LoadClassNames(const std::filesystem::path& path);

/// The class called `name`; an invalid id where there is none.
ClassId FindClass(const std::vector<std::string>& class_names, std::string_view name);

}  // namespace ofm
