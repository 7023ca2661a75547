// Made descriptors. Tests only.
#pragma once

#include <vector>

#include "ofm/base/random.h"
#include "ofm/features/features.h"

namespace ofm {

inline Descriptor RandomDescriptor(RandomEngine& engine) {
  Descriptor descriptor;
  for (std::uint64_t& word : descriptor) word = engine();
  return descriptor;
}

inline std::vector<Descriptor> RandomDescriptors(int count, std::uint64_t seed) {
  RandomEngine engine = MakeRandomEngine(seed, 0);
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < count; ++i) descriptors.push_back(RandomDescriptor(engine));
  return descriptors;
}

/// With `count` bits turned at random; some may be turned back.
inline Descriptor Disturbed(Descriptor descriptor, int count, RandomEngine& engine) {
  for (int i = 0; i < count; ++i) {
    const std::uint32_t bit = UniformIndex(engine, 256);
    descriptor[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

/// `per_centre` descriptors near each of `centres`, in turn.
inline std::vector<Descriptor> DescriptorsNear(const std::vector<Descriptor>& centres,
                                               int per_centre, RandomEngine& engine) {
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < per_centre; ++i) {
    for (const Descriptor& centre : centres) {
      descriptors.push_back(Disturbed(centre, 12, engine));
    }
  }
  return descriptors;
}

}  // namespace ofm
