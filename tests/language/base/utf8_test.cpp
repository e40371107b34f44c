#include "base/utf8.hpp"

#include <gtest/gtest.h>

namespace language {
namespace {

using std::string_view_literals::operator""sv;

TEST(Utf8, CountsCodePoints) {
  EXPECT_EQ(count_code_points(""), 0u);
  EXPECT_EQ(count_code_points("abc"), 3u);
  EXPECT_EQ(count_code_points("aé€𝄞"), 4u);
}

TEST(Utf8, StepsThroughBytesThatAreNoUtf8) {
  EXPECT_EQ(count_code_points("a\xff"
                              "b\x80"
                              "c\xc3"),
            5u);                                   // \xc3 is cut off
  EXPECT_EQ(count_code_points("\xe2\x82zz"), 2u);  // "z" belongs to the first
  EXPECT_EQ(count_code_points("\xf8\x88\x80\x80\x80"sv), 1u);
}

TEST(Utf8, FindsCodePoints) {
  EXPECT_EQ(code_point_offset("aé€x", 3), 6u);
  EXPECT_EQ(code_point_length("€x"), 3u);
  EXPECT_EQ(code_point_length("\xe2\x82"), 0u);
}

TEST(Utf8, DecodesAndEncodes) {
  for (const uint32_t code_point : {0x41u, 0xE9u, 0x20ACu, 0x1D11Eu, 0x10FFFFu}) {
    std::string text;
    append_code_point(text, code_point);
    EXPECT_EQ(first_code_point(text), code_point);
    EXPECT_TRUE(is_valid_utf8(text));
  }
}

TEST(Utf8, KnowsWhatIsInvalid) {
  for (const std::string_view text :
       {"\xff"sv, "a\xc3"sv, "\xc0\x80"sv, "\xed\xa0\x80"sv, "\xf4\x90\x80\x80"sv,
        "\xf8\x88\x80\x80\x80"sv, "\x80"sv, "\xe2zz"sv})
    EXPECT_FALSE(is_valid_utf8(text)) << text;
  EXPECT_EQ(first_code_point("\xe2zz"), first_code_point("\xff"));
}

}  // namespace
}  // namespace language
