#include "ofm/features/hamming.h"

#include "ofm/base/check.h"

namespace ofm {
namespace {

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
__attribute__((target("popcnt"))) void DistancesWithPopcount(const Descriptor& query,
                                                             std::span<const Descriptor> train,
                                                             std::span<std::uint16_t> out) {
  for (std::size_t i = 0; i < train.size(); ++i) {
    std::uint64_t bits = 0;
    for (int word = 0; word < 4; ++word) {
      bits += static_cast<std::uint64_t>(__builtin_popcountll(query[word] ^ train[i][word]));
    }
    out[i] = static_cast<std::uint16_t>(bits);
  }
}
bool HasPopcount() { return __builtin_cpu_supports("popcnt") != 0; }
#else
bool HasPopcount() { return false; }
void DistancesWithPopcount(const Descriptor&, std::span<const Descriptor>,
                           std::span<std::uint16_t>) {}
#endif

}  // namespace

void HammingDistances(const Descriptor& query, std::span<const Descriptor> train,
                      std::span<std::uint16_t> out) {
  OFM_CHECK(train.size() == out.size());
  if (HasPopcount()) return DistancesWithPopcount(query, train, out);
  for (std::size_t i = 0; i < train.size(); ++i) {
    out[i] = static_cast<std::uint16_t>(HammingDistance(query, train[i]));
  }
}

}  // namespace ofm
