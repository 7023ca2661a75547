#include "ofm/perception/class_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "ofm/base/error.h"

namespace ofm {

const std::vector<std::string>& CocoClassNames() {
  static const std::vector<std::string> kNames = {"person",        "bicycle",      "car",
                                                  "motorcycle",    "airplane",     "bus",
                                                  "train",         "truck",        "boat",
                                                  "traffic light", "fire hydrant", "stop sign",
                                                  "parking meter", "bench",        "bird",
                                                  "cat",           "dog",          "horse",
                                                  "sheep",         "cow",          "elephant",
                                                  "bear",          "zebra",        "giraffe",
                                                  "backpack",      "umbrella",     "handbag",
                                                  "tie",           "suitcase",     "frisbee",
                                                  "skis",          "snowboard",    "sports ball",
                                                  "kite",          "baseball bat", "baseball glove",
                                                  "skateboard",    "surfboard",    "tennis racket",
                                                  "bottle",        "wine glass",   "cup",
                                                  "fork",          "knife",        "spoon",
                                                  "bowl",          "banana",       "apple",
                                                  "sandwich",      "orange",       "broccoli",
                                                  "carrot",        "hot dog",      "pizza",
                                                  "donut",         "cake",         "chair",
                                                  "couch",         "potted plant", "bed",
                                                  "dining table",  "toilet",       "tv",
                                                  "laptop",        "mouse",        "remote",
                                                  "keyboard",      "cell phone",   "microwave",
                                                  "oven",          "toaster",      "sink",
                                                  "refrigerator",  "book",         "clock",
                                                  "vase",          "scissors",     "teddy bear",
                                                  "hair drier",    "toothbrush"};
  return kNames;
}

std::vector<std::string> LoadClassNames(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw Error(path, "cannot read the class names; give a text file with one name a line");
  }
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    names.push_back(line);
  }
  while (!names.empty() && names.back().empty()) names.pop_back();
  if (names.empty()) throw Error(path, "holds no class name; write one a line");
  if (names.size() > kMaxClasses) {
    throw Error(path, fmt::format("has {} class names; {} are allowed", names.size(), kMaxClasses));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int line = static_cast<int>(i) + 1;
    if (names[i].empty()) throw Error(path, line, "empty class name between others");
    if (FindClass(names, names[i]).value != i) {
      throw Error(path, line, fmt::format("class '{}' is listed twice", names[i]));
    }
  }
  return names;
}

ClassId FindClass(const std::vector<std::string>& class_names, std::string_view name) {
  const auto found = std::find(class_names.begin(), class_names.end(), name);
  if (found == class_names.end()) return {};
  return ClassId(static_cast<std::uint32_t>(found - class_names.begin()));
}

}  // namespace ofm
