#include "ofm/io/image_file.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/io/read_file.h"

namespace ofm {
namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kJpegStart("\xff\xd8\xff", 3);
constexpr std::string_view kJpegEnd("\xff\xd9", 2);

std::size_t BigEndian32(std::string_view bytes) {
  std::size_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// Follows the chunks (length, type, data, checksum) to the end chunk.
bool IsWholePng(std::string_view bytes) {
  bytes.remove_prefix(kPngSignature.size());
  while (bytes.size() >= 12) {
    const std::size_t chunk = 12 + BigEndian32(bytes);
    if (chunk > bytes.size()) return false;
    if (bytes.substr(4, 4) == "IEND") return true;
    bytes.remove_prefix(chunk);
  }
  return false;
}

/// Looks for the end marker; some cameras pad the file with zeros.
bool IsWholeJpeg(std::string_view bytes) {
  const std::size_t last = bytes.find_last_not_of('\0');
  return last != std::string_view::npos && bytes.substr(0, last + 1).ends_with(kJpegEnd);
}

void RequireWhole(const std::filesystem::path& path, std::string_view bytes) {
  if (bytes.empty()) throw Error(path, "is empty (0 bytes); copy or download it again");
  const bool png = bytes.starts_with(kPngSignature);
  if (!png && !bytes.starts_with(kJpegStart)) {
    throw Error(path, "is neither a PNG nor a JPEG image");
  }
  if (png ? !IsWholePng(bytes) : !IsWholeJpeg(bytes)) {
    throw Error(
        path, fmt::format("is truncated after {} bytes; copy or download it again", bytes.size()));
  }
}

std::string Kind(const cv::Mat& image) {
  const std::size_t bits = 8 * image.elemSize1();
  return fmt::format("{} channel{} of {} bits", image.channels(), image.channels() == 1 ? "" : "s",
                     bits);
}

}  // namespace

cv::Mat LoadImage(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  RequireWhole(path, bytes);
  cv::Mat image;
  try {
    // imdecode only reads the bytes.
    const cv::Mat view(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    image = cv::imdecode(view, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw Error(path, "is damaged and cannot be decoded; copy it again");
  return image;
}

cv::Mat LoadColorImage(const std::filesystem::path& path) {
  cv::Mat image = LoadImage(path);
  if (image.type() != CV_8UC3) {
    throw Error(path, fmt::format("has {}, but a colour image must have 3 channels of 8 bits",
                                  Kind(image)));
  }
  return image;
}

cv::Mat LoadDepthImage(const std::filesystem::path& path, double depth_scale) {
  OFM_CHECK(depth_scale > 0);
  const cv::Mat image = LoadImage(path);
  if (image.type() != CV_16UC1) {
    throw Error(
        path, fmt::format("has {}, but a depth image must have 1 channel of 16 bits", Kind(image)));
  }
  cv::Mat depth_m;
  image.convertTo(depth_m, CV_32FC1, 1 / depth_scale);
  return depth_m;
}

cv::Mat LoadMaskImage(const std::filesystem::path& path, cv::Size size) {
  cv::Mat mask = LoadImage(path);
  if (mask.type() != CV_8UC1 || mask.size() != size) {
    throw Error(path, "is no 8-bit instance mask of the frame's size");
  }
  return mask;
}

}  // namespace ofm
