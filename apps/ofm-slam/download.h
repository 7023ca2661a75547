// Files from the network, by libcurl.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>

namespace ofm {

struct Download {
  std::string address;  ///< http or https
  /// Takes the bytes in their order.
  std::function<void(std::span<const char>)> take;
  /// Told now and then: bytes so far, and in all (0 = not known).
  std::function<void(std::uint64_t, std::uint64_t)> progress;
  std::stop_token stop;
};

/// Follows redirections. Throws Error with the address and the reason where it cannot be fetched
/// whole, and where a stop was requested; passes on what `take` throws.
void Fetch(const Download& download);

}  // namespace ofm
