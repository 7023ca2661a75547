#include "instance_writer.h"

#include <array>
#include <opencv2/core.hpp>
#include <utility>

#include "ofm/perception/class_names.h"
#include "ofm/perception/instance_file.h"

namespace ofm {

InstanceWriter::InstanceWriter(const Scene& scene, std::filesystem::path folder)
    : folder_(std::move(folder)) {
  for (const std::string& name : scene.class_names()) {
    class_ids_.push_back(FindClass(CocoClassNames(), name));
  }
}

void InstanceWriter::Write(const SimFrame& frame) const {
  constexpr int kLeastPixels = 60;
  std::array<int, 256> pixels{};
  for (int y = 0; y < frame.instance.rows; ++y) {
    const uchar* row = frame.instance.ptr(y);
    for (int x = 0; x < frame.instance.cols; ++x) ++pixels[row[x]];
  }
  Segmentation segmentation{frame.frame.id, {}};
  for (std::size_t id = 1; id < class_ids_.size(); ++id) {
    if (!class_ids_[id].valid() || pixels[id] < kLeastPixels) continue;
    Instance instance{
        InstanceId(static_cast<std::uint32_t>(id)), class_ids_[id], 1.0F, {}, frame.instance == id};
    segmentation.instances.push_back(std::move(instance));
  }
  SaveInstances(folder_ / (frame.frame.name + ".json"), segmentation, CocoClassNames());
}

}  // namespace ofm
