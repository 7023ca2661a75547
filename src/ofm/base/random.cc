#include "ofm/base/random.h"

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// SplitMix64's finaliser (Steele, Lea, Flood 2014): spreads neighbouring seeds apart.
std::uint64_t Mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

RandomEngine MakeRandomEngine(std::uint64_t seed, std::uint64_t stream) {
  return RandomEngine(Mix(Mix(seed) ^ stream));
}

std::uint32_t UniformIndex(RandomEngine& engine, std::uint32_t bound) {
  OFM_CHECK(bound > 0);
  return static_cast<std::uint32_t>(((engine() >> 32) * bound) >> 32);
}

double UniformReal(RandomEngine& engine) { return static_cast<double>(engine() >> 11) * 0x1.0p-53; }

}  // namespace ofm
