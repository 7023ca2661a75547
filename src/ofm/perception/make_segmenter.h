// The segmenter that the options ask for.
#pragma once

#include <filesystem>
#include <memory>

#include "ofm/perception/perception_options.h"
#include "ofm/perception/segmenter.h"

namespace ofm {

/// `sequence_folder` is where masks are looked for unless options.masks_folder says otherwise.
/// Throws Error where a folder, network or class list cannot be used.
std::unique_ptr<Segmenter> MakeSegmenter(const PerceptionOptions& options,
                                         const std::filesystem::path& sequence_folder);

}  // namespace ofm
