#include "ofm/perception/class_map.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "ofm/base/check.h"

namespace ofm {

ClassMap MakeContiguousClassMap(int class_count) {
  OFM_CHECK(class_count >= 0);
  ClassMap map(1);
  for (int i = 0; i < class_count; ++i) map.emplace_back(static_cast<std::uint32_t>(i));
  return map;
}

ClassMap MakeCoco91ClassMap() {
  constexpr int kLastLabel = 90;
  // street sign, hat, shoe, eye glasses, plate, mirror, window, desk, door, blender: never
  // annotated
  constexpr std::array kGaps = {12, 26, 29, 30, 45, 66, 68, 69, 71, 83};
  ClassMap map(1);
  std::uint32_t next = 0;
  for (int label = 1; label <= kLastLabel; ++label) {
    const bool gap = std::find(kGaps.begin(), kGaps.end(), label) != kGaps.end();
    map.push_back(gap ? ClassId() : ClassId(next++));
  }
  return map;
}

ClassId FindClassOfLabel(const ClassMap& map, int label) {
  return label >= 0 && label < std::ssize(map) ? map[label] : ClassId();
}

}  // namespace ofm
