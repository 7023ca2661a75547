#include "ofm/perception/instance_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "ofm/base/error.h"
#include "ofm/io/atomic_file.h"
#include "ofm/io/read_file.h"
#include "ofm/perception/class_names.h"

namespace ofm {
namespace {

using Json = nlohmann::json;

/// The first of `bytes` from `begin` on that is not `value`; the end where there is none.
std::size_t SkipRun(const std::uint8_t* bytes, std::size_t begin, std::size_t end,
                    std::uint8_t value) {
  std::uint64_t eight = 0, same = 0;
  std::memset(&same, value, sizeof(same));
  while (begin + sizeof(eight) <= end) {
    std::memcpy(&eight, bytes + begin, sizeof(eight));
    if (eight != same) break;
    begin += sizeof(eight);
  }
  while (begin < end && bytes[begin] == value) ++begin;
  return begin;
}

/// Lengths of the runs of 0 and 1, down the columns.
std::vector<int> EncodeRuns(const cv::Mat& mask) {
  const cv::Mat columns = cv::Mat(mask.t()) != 0;  // continuous, 0 and 255
  std::vector<int> runs;
  std::uint8_t value = 0;
  std::size_t begin = 0;
  do {
    const std::size_t end = SkipRun(columns.data, begin, columns.total(), value);
    runs.push_back(static_cast<int>(end - begin));
    begin = end;
    value = static_cast<std::uint8_t>(~value);
  } while (begin < columns.total());
  return runs;
}

/// Throws std::invalid_argument for runs that do not fill `size`.
cv::Mat DecodeRuns(const std::vector<int>& runs, cv::Size size) {
  cv::Mat columns = cv::Mat::zeros(size.width, size.height, CV_8UC1);
  std::int64_t at = 0;
  bool is_set = false;
  for (const int length : runs) {
    if (length < 0 || at + length > size.area()) {
      throw std::invalid_argument("the runs of a mask do not fit into the image");
    }
    if (is_set) std::fill_n(columns.data + at, length, std::uint8_t{255});
    at += length;
    is_set = !is_set;
  }
  if (at != size.area()) throw std::invalid_argument("the runs of a mask do not fill the image");
  return columns.t();
}

Instance ParseInstance(const Json& json, cv::Size size, const std::vector<std::string>& names) {
  const auto& segmentation = json.at("segmentation");
  const auto shape = segmentation.at("size").get<std::vector<int>>();
  if (shape != std::vector<int>{size.height, size.width}) {
    throw std::invalid_argument(
        fmt::format("a mask is not {} x {} px as its frame is", size.width, size.height));
  }
  const auto category = json.at("category").get<std::string>();
  Instance instance;
  instance.class_id = FindClass(names, category);
  if (!instance.class_id.valid()) {
    throw std::invalid_argument("unknown class '" + category + "'; see class_names_file");
  }
  instance.score = json.at("score").get<float>();
  if (!(instance.score >= 0 && instance.score <= 1)) {
    throw std::invalid_argument("a score is not within 0 and 1");
  }
  instance.mask = DecodeRuns(segmentation.at("counts").get<std::vector<int>>(), size);
  instance.box = cv::boundingRect(instance.mask);
  return instance;
}

}  // namespace

void SaveInstances(const std::filesystem::path& path, const Segmentation& segmentation,
                   const std::vector<std::string>& class_names) {
  Json json = Json::array();
  for (const Instance& instance : segmentation.instances) {
    json.push_back({{"category", class_names.at(instance.class_id.value)},
                    {"score", instance.score},
                    {"segmentation",
                     {{"size", {instance.mask.rows, instance.mask.cols}},
                      {"counts", EncodeRuns(instance.mask)}}}});
  }
  WriteFileAtomically(path, json.dump() + "\n");
}

Segmentation LoadInstances(const std::filesystem::path& path, cv::Size size,
                           const std::vector<std::string>& class_names) {
  Segmentation segmentation;
  const std::string text = ReadFile(path);
  try {
    for (const Json& json : Json::parse(text)) {
      Instance instance = ParseInstance(json, size, class_names);
      if (instance.box.empty()) continue;
      instance.id = InstanceId(static_cast<std::uint32_t>(segmentation.instances.size() + 1));
      segmentation.instances.push_back(std::move(instance));
    }
  } catch (const Json::exception& error) {
    throw Error(path, fmt::format("is no list of instances ({})", error.what()));
  } catch (const std::invalid_argument& error) {
    throw Error(path, error.what());
  }
  return segmentation;
}

}  // namespace ofm
