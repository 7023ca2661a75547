// Pictures as PNG files.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace ofm {

/// Little compressed, for speed; the file is whole or not there. Throws Error where it cannot be
/// written.
void WritePng(const std::filesystem::path& path, const cv::Mat& image);

}  // namespace ofm
