#include "ofm/view/message_board.h"

#include <gtest/gtest.h>

#include <vector>

namespace ofm {
namespace {

ViewMessage Text(const std::string& text) {
  return {std::make_shared<const std::string>(text), true};
}

/// What a viewer is sent who has seen all up to `number`.
std::vector<std::string> ReadFrom(const MessageBoard& board, std::uint64_t number) {
  std::vector<std::string> texts;
  while (const MessageBoard::Post* post = board.Next(number)) {
    texts.push_back(*post->message.bytes);
    number = post->number;
  }
  return texts;
}

using Texts = std::vector<std::string>;

TEST(MessageBoard, IsEmptyAtFirst) { EXPECT_EQ(MessageBoard().Next(0), nullptr); }

TEST(MessageBoard, NewViewersGetEachNamesNewestInTheOrderOfTheirPosting) {
  MessageBoard board;
  board.Put("state", Text("1"));
  board.Put("cloud", Text("a"));
  board.Put("state", Text("2"));
  EXPECT_EQ(ReadFrom(board, 0), (Texts{"a", "2"}));
}

TEST(MessageBoard, WhoHasSeenAllGetsOnlyWhatIsNew) {
  MessageBoard board;
  board.Put("state", Text("1"));
  const std::uint64_t seen = board.Next(0)->number;
  EXPECT_EQ(ReadFrom(board, seen), Texts{});
  board.Put("state", Text("2"));
  board.Put("state", Text("3"));
  EXPECT_EQ(ReadFrom(board, seen), Texts{"3"});
}

}  // namespace
}  // namespace ofm
