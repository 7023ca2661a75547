#include "ofm/io/tum_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/base/time.h"
#include "ofm/io/image_file.h"

namespace ofm {
namespace {

/// Reads an image by `load`; an error also names the list and line that want it.
template <class Loader>
cv::Mat LoadListed(const ListedImage& listed, const PinholeCamera& camera, Loader&& load) {
  try {
    cv::Mat image = load(listed.path);
    if (image.cols != camera.width || image.rows != camera.height) {
      throw Error(listed.path,
                  fmt::format("is {}x{}, but the camera is {}x{}; choose the right camera",
                              image.cols, image.rows, camera.width, camera.height));
    }
    return image;
  } catch (const Error& error) {
    throw Error(listed.list, listed.line, error.what());
  }
}

void RequireFile(const ListedImage& listed) {
  if (std::filesystem::exists(listed.path)) return;
  throw Error(listed.list, listed.line,
              fmt::format("{}: does not exist; copy it or remove the line", listed.path.string()));
}

}  // namespace

RgbdSequence::RgbdSequence(const std::filesystem::path& folder, const PinholeCamera& camera,
                           double max_difference_s)
    : camera_(camera), index_(ReadTumIndex(folder, max_difference_s)) {}

RgbdFrame RgbdSequence::Load(std::size_t index) const {
  OFM_CHECK(index < size());
  const auto& [color, depth] = index_.entries[index];
  RgbdFrame frame;
  frame.id = FrameId(static_cast<std::uint32_t>(index));
  frame.name = color.path.stem().string();
  frame.stamp_ns = color.stamp_ns;
  frame.depth_stamp_ns = depth.stamp_ns - SecondsToNanoseconds(camera_.depth_delay_s);
  frame.color = LoadListed(color, camera_, LoadColorImage);
  cv::cvtColor(frame.color, frame.gray, cv::COLOR_BGR2GRAY);
  frame.depth_m = LoadListed(depth, camera_, [&](const std::filesystem::path& path) {
    return LoadDepthImage(path, camera_.depth_scale);
  });
  return frame;
}

void RgbdSequence::RequireFiles(std::size_t first, std::size_t count) const {
  const std::size_t end = std::min(size(), first + count);
  for (std::size_t i = first; i < end; ++i) {
    RequireFile(index_.entries[i].color);
    RequireFile(index_.entries[i].depth);
  }
}

TumFrameSource::TumFrameSource(std::shared_ptr<const RgbdSequence> sequence, FrameRange range)
    : sequence_(std::move(sequence)) {
  OFM_CHECK(sequence_ != nullptr && range.first >= 0 && range.max_count >= 0);
  begin_ = next_ = static_cast<std::size_t>(range.first);
  if (begin_ >= sequence_->size()) {
    throw Error(sequence_->folder(), fmt::format("has {} frames; none from number {} on",
                                                 sequence_->size(), range.first));
  }
  const std::size_t rest = sequence_->size() - begin_;
  const std::size_t wanted = static_cast<std::size_t>(range.max_count);
  end_ = begin_ + (wanted == 0 ? rest : std::min(rest, wanted));
  sequence_->RequireFiles(begin_, end_ - begin_);
}

std::optional<RgbdFrame> TumFrameSource::Next() {
  if (next_ == end_) return {};
  const std::size_t index = std::exchange(next_, end_);  // an error ends the sequence
  RgbdFrame frame = sequence_->Load(index);
  next_ = index + 1;
  return frame;
}

}  // namespace ofm
