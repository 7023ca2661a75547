// Hamming distances in bulk.
#pragma once

#include <cstdint>
#include <span>

#include "ofm/features/features.h"

namespace ofm {

/// out[i] = HammingDistance(query, train[i]) with the processor's popcount where it has one. `out`
/// is as long as `train`.
void HammingDistances(const Descriptor& query, std::span<const Descriptor> train,
                      std::span<std::uint16_t> out);

}  // namespace ofm
