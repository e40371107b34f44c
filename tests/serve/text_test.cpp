#include "text.hpp"

#include <gtest/gtest.h>

namespace serve {
namespace {

constexpr auto kUtf16 = PositionEncoding::kUtf16;
constexpr auto kUtf8 = PositionEncoding::kUtf8;

TEST(Text, LinesEndAtFeedsReturnsAndBoth) {
  const Text text("a\nbb\r\nccc\rd");
  EXPECT_EQ(text.lines(), 4u);
  EXPECT_EQ(text.position_of(2, kUtf16), (Position{1, 0}));
  EXPECT_EQ(text.position_of(6, kUtf16), (Position{2, 0}));
  EXPECT_EQ(text.position_of(10, kUtf16), (Position{3, 0}));
  EXPECT_EQ(text.position_of(11, kUtf16), (Position{3, 1}));
}

TEST(Text, CountsUnitsOfItsEncoding) {
  const Text text("x = \"aä€😀\";");  // 1, 2, 3 and 4 bytes
  const std::size_t end = text.bytes().find("\";");
  EXPECT_EQ(text.position_of(end, kUtf16), (Position{0, 10}));
  EXPECT_EQ(text.position_of(end, kUtf8), (Position{0, 15}));
  EXPECT_EQ(text.offset_of({0, 10}, kUtf16), end);
  EXPECT_EQ(text.offset_of({0, 15}, kUtf8), end);
}

TEST(Text, APositionWithinACharacterIsItsBegin) {
  const Text text("😀b");
  EXPECT_EQ(text.offset_of({0, 1}, kUtf16), 0u);
  EXPECT_EQ(text.offset_of({0, 2}, kUtf16), 4u);
  EXPECT_EQ(text.offset_of({0, 3}, kUtf8), 0u);
}

TEST(Text, WhatIsBeyondCountsAsTheEnd) {
  const Text text("ab\r\ncd");
  EXPECT_EQ(text.offset_of({0, 99}, kUtf16), 2u);
  EXPECT_EQ(text.offset_of({1, 99}, kUtf16), 6u);
  EXPECT_EQ(text.offset_of({7, 0}, kUtf16), 6u);
  EXPECT_EQ(text.position_of(99, kUtf16), (Position{1, 2}));
  EXPECT_EQ(Text("").offset_of({0, 0}, kUtf16), 0u);
}

TEST(Text, EveryCharacterOfEveryLineComesBack) {
  const Text text("a😀\r\n\n\rä\xff\xfe€\n");
  for (std::size_t offset = 0; offset <= text.bytes().size(); ++offset) {
    const auto byte = static_cast<unsigned char>(text.bytes()[offset]);
    const bool is_within = (byte & 0xC0) == 0x80 || byte == '\n';
    if (is_within && offset != text.bytes().size()) continue;
    EXPECT_EQ(text.offset_of(text.position_of(offset, kUtf8), kUtf8), offset) << offset;
  }
}

}  // namespace
}  // namespace serve
