#include "ofm/io/prefetching_source.h"

#include <utility>

#include "ofm/base/check.h"

namespace ofm {

PrefetchingSource::PrefetchingSource(std::unique_ptr<FrameSource> source, std::size_t capacity)
    : source_(std::move(source)), queue_(capacity) {
  OFM_CHECK(source_ != nullptr);
  size_ = source_->size();
  thread_ = std::jthread([this](std::stop_token stop) { ReadAll(std::move(stop)); });
}

void PrefetchingSource::ReadAll(std::stop_token stop) {
  try {
    while (!stop.stop_requested()) {
      std::optional<RgbdFrame> frame = source_->Next();
      if (!frame || !queue_.Push(std::move(*frame), stop)) break;
    }
  } catch (...) {
    queue_.Push(std::current_exception(), stop);
  }
  queue_.Close();
}

std::optional<RgbdFrame> PrefetchingSource::Next() {
  std::optional<Item> item = queue_.Pop();
  if (!item) return {};
  if (const auto* error = std::get_if<std::exception_ptr>(&*item)) std::rethrow_exception(*error);
  return std::get<RgbdFrame>(std::move(*item));
}

}  // namespace ofm
