// Distinct identifier types, so that a frame's number is never taken for a landmark's.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>

namespace ofm {

/// An index that cannot be mixed with another kind's. Ids are issued in increasing order from 0.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kInvalid = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t value = kInvalid;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}

  /// True where an object is named.
  constexpr bool valid() const { return value != kInvalid; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

using FrameId = Id<struct FrameTag>;
using KeyframeId = Id<struct KeyframeTag>;
using LandmarkId = Id<struct LandmarkTag>;
/// A part of the map with a world of its own; see ofm/map/submap.h.
using SubmapId = Id<struct SubmapTag>;
using InstanceId = Id<struct InstanceTag>;
/// Index into the segmentation network's class list (0 = person in COCO-80).
using ClassId = Id<struct ClassTag>;

}  // namespace ofm

template <class Tag>
struct std::hash<ofm::Id<Tag>> {
  std::size_t operator()(ofm::Id<Tag> id) const noexcept { return id.value; }
};
