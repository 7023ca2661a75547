#include "ofm/pipeline/keyframe_images.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "ofm/base/time.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/make_folder.h"

namespace ofm {
namespace {

constexpr int kWidth_px = 240;
constexpr int kJpegQuality = 80;

cv::Mat Shrunk(const cv::Mat& image, cv::InterpolationFlags how) {
  const int height = static_cast<int>(std::lround(1.0 * image.rows * kWidth_px / image.cols));
  cv::Mat small;
  cv::resize(image, small, {kWidth_px, std::max(height, 1)}, 0, 0, how);
  return small;
}

std::vector<unsigned char> Draw(const PreparedFrame& prepared) {
  const cv::Scalar red(40, 40, 230), white(255, 255, 255);
  cv::Mat image = Shrunk(prepared.frame.color, cv::INTER_AREA);
  if (!prepared.dynamic.mask.empty()) {
    cv::Mat tinted;
    cv::addWeighted(image, 0.45, cv::Mat(image.size(), image.type(), red), 0.55, 0, tinted);
    tinted.copyTo(image, Shrunk(prepared.dynamic.mask, cv::INTER_NEAREST));
  }
  for (const Instance& instance : prepared.segmentation.instances) {
    std::vector<std::vector<cv::Point>> outline;
    cv::findContours(Shrunk(instance.mask, cv::INTER_NEAREST), outline, cv::RETR_EXTERNAL,
                     cv::CHAIN_APPROX_SIMPLE);
    cv::drawContours(image, outline, -1, white, 1, cv::LINE_AA);
  }
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", image, jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return jpeg;
}

}  // namespace

void KeyframeImages::OnFrame(const FrameReport& report) {
  if (!report.tracking.keyframe || max_count_ == 0) return;
  if (seen_++ % stride_ != 0) return;
  images_.push_back({report.prepared.frame.stamp_ns, Draw(report.prepared)});
  if (images_.size() <= max_count_) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < images_.size(); i += 2) {
    if (i != kept) images_[kept] = std::move(images_[i]);
    ++kept;
  }
  images_.resize(kept);
  stride_ *= 2;
}

void WriteKeyframeImages(const std::filesystem::path& folder,
                         const std::vector<KeyframeImage>& images) {
  std::error_code ignored;
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".jpg") old.push_back(entry.path());
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file, ignored);
  if (images.empty()) {
    std::filesystem::remove(folder, ignored);  // stays where others put something in it
    return;
  }
  MakeFolder(folder);
  for (const KeyframeImage& image : images) {
    WriteFileAtomically(
        folder / (FormatSeconds(image.stamp_ns) + ".jpg"),
        std::string_view(reinterpret_cast<const char*>(image.jpeg.data()), image.jpeg.size()));
  }
}

}  // namespace ofm
