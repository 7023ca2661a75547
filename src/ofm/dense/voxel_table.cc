#include "ofm/dense/voxel_table.h"

#include <algorithm>
#include <numeric>

namespace ofm {
namespace {

constexpr int kInitialBits = 6;

std::uint64_t PackKey(const VoxelIndex& voxel) {
  const auto part = [](int v) { return static_cast<std::uint64_t>(v + kVoxelLimit); };
  return part(voxel.x()) << 32 | part(voxel.y()) << 16 | part(voxel.z());
}

}  // namespace

VoxelTable::VoxelTable() : slots_(std::size_t{1} << kInitialBits), shift_(64 - kInitialBits) {}

std::size_t VoxelTable::FindSlot(std::uint64_t key) const {
  constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15;
  std::size_t slot = key * kGoldenRatio >> shift_;
  while (slots_[slot] != 0 && keys_[slots_[slot] - 1] != key) {
    slot = (slot + 1) & (slots_.size() - 1);
  }
  return slot;
}

std::uint32_t VoxelTable::Insert(const VoxelIndex& voxel) {
  const std::uint64_t key = PackKey(voxel);
  std::size_t slot = FindSlot(key);
  if (slots_[slot] != 0) return slots_[slot] - 1;
  if (2 * (keys_.size() + 1) > slots_.size()) {
    Grow();
    slot = FindSlot(key);
  }
  keys_.push_back(key);
  slots_[slot] = static_cast<std::uint32_t>(keys_.size());
  return slots_[slot] - 1;
}

std::optional<std::uint32_t> VoxelTable::Find(const VoxelIndex& voxel) const {
  const std::uint32_t found = slots_[FindSlot(PackKey(voxel))];
  if (found == 0) return {};
  return found - 1;
}

VoxelIndex VoxelTable::At(std::uint32_t number) const {
  const std::uint64_t key = keys_[number];
  const auto part = [&](int bits) { return static_cast<int>(key >> bits & 0xFFFF) - kVoxelLimit; };
  return {part(32), part(16), part(0)};
}

std::vector<std::uint32_t> VoxelTable::SortedNumbers() const {
  std::vector<std::uint32_t> numbers(keys_.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::sort(numbers.begin(), numbers.end(),
            [this](std::uint32_t a, std::uint32_t b) { return keys_[a] < keys_[b]; });
  return numbers;
}

std::size_t VoxelTable::MemoryBytes() const {
  return slots_.capacity() * sizeof(slots_[0]) + keys_.capacity() * sizeof(keys_[0]);
}

void VoxelTable::Grow() {
  slots_.assign(2 * slots_.size(), 0);
  --shift_;
  for (std::uint32_t number = 0; number < keys_.size(); ++number) {
    slots_[FindSlot(keys_[number])] = number + 1;
  }
}

}  // namespace ofm
