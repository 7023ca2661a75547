// What viewers are to know, under names: a viewer that is slow misses older states, never the
// newest.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace ofm {

/// A message of a web socket; viewers share its bytes.
struct ViewMessage {
  std::shared_ptr<const std::string> bytes;
  bool is_text = false;
};

/// The newest message of each name, in the order in which they were put. Who has seen all up to a
/// number asks for the next: one that was put anew comes again, as the newest. Serves one thread.
class MessageBoard {
 public:
  struct Post {
    std::uint64_t number = 0;  ///< from 1
    ViewMessage message;
  };

  /// Replaces what was there under the name.
  void Put(const std::string& name, ViewMessage message);
  /// The oldest post after `number`; null where there is none. Good until the next Put.
  const Post* Next(std::uint64_t number) const;

 private:
  std::map<std::uint64_t, Post> posts_;
  std::map<std::string, std::uint64_t> numbers_;
  std::uint64_t last_ = 0;
};

}  // namespace ofm
