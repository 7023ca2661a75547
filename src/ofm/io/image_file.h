// Images of a sequence, checked: what is damaged or of the wrong kind is an error, never a picture
// that is partly grey.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace ofm {

/// A PNG or JPEG as it is stored (depth, channels; BGR order; EXIF rotation not applied). Throws
/// Error that names the file: missing, not an image of these formats, truncated, or damaged.
cv::Mat LoadImage(const std::filesystem::path& path);

/// An 8-bit colour image, CV_8UC3 in BGR order; throws where it is of another kind.
cv::Mat LoadColorImage(const std::filesystem::path& path);

/// A 16-bit depth image with `depth_scale` units per metre as CV_32FC1 [m], 0 = not measured;
/// throws where it is of another kind.
cv::Mat LoadDepthImage(const std::filesystem::path& path, double depth_scale);

/// A mask or image of instance ids, CV_8UC1 of `size`, which is the frame's; throws where it is of
/// another kind or size.
cv::Mat LoadMaskImage(const std::filesystem::path& path, cv::Size size);

}  // namespace ofm
