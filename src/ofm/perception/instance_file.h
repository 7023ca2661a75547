// Instances of a frame in a file, so that a network needs to run only once.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ofm/perception/segmentation.h"

namespace ofm {

/// Writes a JSON array with, for each instance, "category" (the class's name), "score" and
/// "segmentation": {"size": [height, width], "counts": [...]}, the uncompressed run-length code of
/// COCO's results format (runs of 0 and 1 in turn down the columns, 0 first; Lin et al., ECCV
/// 2014). Throws Error where it cannot be written.
void SaveInstances(const std::filesystem::path& path, const Segmentation& segmentation,
                   const std::vector<std::string>& class_names);

/// Reads such a file for a frame of `size`; instances are numbered from 1 in their order. Throws
/// Error that names the file where it is missing, is no such JSON, has another size, a class that
/// is not among `class_names`, or runs that do not fill the image.
Segmentation LoadInstances(const std::filesystem::path& path, cv::Size size,
                           const std::vector<std::string>& class_names);

}  // namespace ofm
