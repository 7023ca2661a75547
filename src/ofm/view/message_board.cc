#include "ofm/view/message_board.h"

#include <utility>

namespace ofm {

void MessageBoard::Put(const std::string& name, ViewMessage message) {
  std::uint64_t& number = numbers_[name];
  posts_.erase(number);
  number = ++last_;
  posts_.emplace(number, Post{number, std::move(message)});
}

const MessageBoard::Post* MessageBoard::Next(std::uint64_t number) const {
  const auto post = posts_.upper_bound(number);
  return post == posts_.end() ? nullptr : &post->second;
}

}  // namespace ofm
