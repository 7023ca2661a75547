// How a run outlives what goes wrong in it.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace ofm {

/// Calls `work`; an error of the input, a library or the machine goes into `error`, where the first
/// one stays. A programmer's error (std::logic_error) is thrown on.
template <class Work>
void KeepError(std::string& error, Work&& work) {
  try {
    std::forward<Work>(work)();
  } catch (const std::logic_error&) {
    throw;
  } catch (const std::exception& caught) {
    if (error.empty()) error = caught.what();
  }
}

}  // namespace ofm
