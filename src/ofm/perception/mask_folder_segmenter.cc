#include "ofm/perception/mask_folder_segmenter.h"

#include <fmt/format.h>

#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "ofm/base/error.h"
#include "ofm/io/image_file.h"
#include "ofm/perception/class_names.h"
#include "ofm/perception/instance_file.h"

namespace ofm {
namespace {

constexpr std::size_t kMaxInstances = 255;

cv::Mat ReadInstanceImage(const std::filesystem::path& path, cv::Size size) {
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(path, "no mask for this frame; add the file or choose another segmenter");
  }
  const cv::Mat ids = LoadImage(path);
  if (ids.type() != CV_8UC1 && ids.type() != CV_16UC1) {
    throw Error(path, fmt::format("is {}; a mask has one channel of 8 or 16 bits with instance ids",
                                  cv::typeToString(ids.type())));
  }
  if (ids.size() != size) {
    throw Error(path, fmt::format("is {} x {} px but its frame is {} x {}; make them equal",
                                  ids.cols, ids.rows, size.width, size.height));
  }
  return ids;
}

/// Corners of the pixels of one instance.
struct Extent {
  int left, top, right, bottom;  // inclusive
};

/// The extent of every id but 0. Throws Error for more than kMaxInstances.
template <class T>
std::map<std::uint32_t, Extent> FindInstances(const cv::Mat& ids,
                                              const std::filesystem::path& path) {
  std::map<std::uint32_t, Extent> extents;
  for (int y = 0; y < ids.rows; ++y) {
    const T* row = ids.ptr<T>(y);
    for (int x = 0; x < ids.cols; ++x) {
      const T id = row[x];
      if (id == 0) continue;
      const int left = x;
      while (x + 1 < ids.cols && row[x + 1] == id) ++x;
      Extent& extent = extents.try_emplace(id, Extent{left, y, x, y}).first->second;
      extent.left = std::min(extent.left, left);
      extent.right = std::max(extent.right, x);
      extent.bottom = y;
    }
    if (extents.size() > kMaxInstances) {
      throw Error(path, fmt::format("has over {} instances; is it really a mask of instance ids?",
                                    kMaxInstances));
    }
  }
  return extents;
}

}  // namespace

MaskFolderSegmenter::MaskFolderSegmenter(MaskFolder folder) : folder_(std::move(folder)) {
  if (!std::filesystem::is_directory(folder_.path)) {
    throw Error(folder_.path,
                "no such folder of masks; set perception.masks_folder or choose another segmenter");
  }
  class_id_ = FindClass(folder_.class_names, folder_.mask_class);
  if (!class_id_.valid()) {
    class_id_ = ClassId(static_cast<std::uint32_t>(folder_.class_names.size()));
    folder_.class_names.push_back(folder_.mask_class);
  }
  if (folder_.class_names.size() > kMaxClasses) {
    throw Error(fmt::format("the class '{}' would be number {}; {} classes are allowed",
                            folder_.mask_class, folder_.class_names.size(), kMaxClasses));
  }
}

Segmentation MaskFolderSegmenter::Segment(const RgbdFrame& frame) {
  if (frame.name.empty()) {
    throw Error(folder_.path,
                "masks are found by the colour file's name, and this source gives none");
  }
  const std::filesystem::path list = folder_.path / (frame.name + ".json");
  const std::filesystem::path path = folder_.path / (frame.name + ".png");
  const bool image_counts =
      folder_.preferred == MaskFiles::kImages && std::filesystem::exists(path);
  if (std::filesystem::exists(list) && !image_counts) {
    Segmentation segmentation = LoadInstances(list, frame.color.size(), folder_.class_names);
    segmentation.frame_id = frame.id;
    return segmentation;
  }
  const cv::Mat ids = ReadInstanceImage(path, frame.color.size());
  const auto extents = ids.depth() == CV_8U ? FindInstances<std::uint8_t>(ids, path)
                                            : FindInstances<std::uint16_t>(ids, path);
  Segmentation segmentation{frame.id, {}};
  for (const auto& [id, extent] : extents) {
    Instance instance{InstanceId(id), class_id_, 1.0F, {}, {}};
    instance.box = cv::Rect(cv::Point(extent.left, extent.top),
                            cv::Point(extent.right + 1, extent.bottom + 1));
    cv::compare(ids, cv::Scalar(id), instance.mask, cv::CMP_EQ);
    segmentation.instances.push_back(std::move(instance));
  }
  return segmentation;
}

}  // namespace ofm
