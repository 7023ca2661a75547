// Seeded random engines: every draw is decided by the config's seed and the frame.
#pragma once

#include <cstdint>
#include <random>

namespace ofm {

using RandomEngine = std::mt19937_64;

/// An engine for one use: the same (seed, stream) always gives the same draws. `stream` is the
/// frame's id, or a number that tells uses apart.
RandomEngine MakeRandomEngine(std::uint64_t seed, std::uint64_t stream);

/// Uniform in [0, bound), without the implementation-defined std::uniform_int_distribution.
std::uint32_t UniformIndex(RandomEngine& engine, std::uint32_t bound);

/// Uniform in [0, 1).
double UniformReal(RandomEngine& engine);

}  // namespace ofm
