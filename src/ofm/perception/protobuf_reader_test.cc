#include "ofm/perception/protobuf_reader.h"

#include <gtest/gtest.h>

#include "ofm/perception/test_support.h"

namespace ofm {
namespace {

TEST(ProtobufReader, GivesNumbersAndBytesInTheirOrder) {
  const std::string message = test::Message().Number(1, 300).Bytes(2, "ab").Number(1, 7).bytes();
  ProtobufReader reader(message);
  const auto first = reader.Next(), second = reader.Next(), third = reader.Next();
  ASSERT_TRUE(first && second && third);
  EXPECT_EQ(first->number, 1U);
  EXPECT_EQ(first->value, 300U);
  EXPECT_EQ(second->bytes, "ab");
  EXPECT_EQ(third->value, 7U);
  EXPECT_FALSE(reader.Next());
}

TEST(ProtobufReader, FixedWidthsAreSkipped) {
  const std::string message = std::string("\x09") + "12345678" + "\x15" + "1234" + "\x18\x05";
  ProtobufReader reader(message);
  EXPECT_EQ(reader.Next()->number, 1U);
  EXPECT_EQ(reader.Next()->number, 2U);
  EXPECT_EQ(reader.Next()->value, 5U);
}

TEST(ProtobufReader, LastFieldOfANumberCounts) {
  const std::string message = test::Message().Bytes(3, "a").Bytes(3, "b").Bytes(4, "c").bytes();
  EXPECT_EQ(FindProtobufBytes(message, 3), "b");
  EXPECT_EQ(FindProtobufBytes(message, 5), "");
}

TEST(ProtobufReader, MessageThatEndsTooEarlyIsMalformed) {
  const std::string message = test::Message().Bytes(2, "a longer text").bytes();
  for (std::size_t size = 1; size < message.size(); ++size) {
    EXPECT_THROW(FindProtobufBytes(message.substr(0, size), 2), MalformedMessage) << size;
  }
}

TEST(ProtobufReader, WhatIsNoMessageIsMalformed) {
  EXPECT_THROW(FindProtobufBytes(std::string(3, '\0'), 1), MalformedMessage);     // field 0
  EXPECT_THROW(FindProtobufBytes("\x0B\x01", 1), MalformedMessage);               // a group
  EXPECT_THROW(FindProtobufBytes(std::string(12, '\xFF'), 1), MalformedMessage);  // endless number
}

}  // namespace
}  // namespace ofm
