#include "png_writer.h"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "ofm/io/atomic_file.h"

namespace ofm {

void WritePng(const std::filesystem::path& path, const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  WriteFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace ofm
