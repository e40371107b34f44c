#include "frontend/terminal.hpp"

#include <gtest/gtest.h>

namespace frontend {
namespace {

TEST(Visible, SpellsWhatSteersATerminal) {
  EXPECT_EQ(visible("\x1b[31mRED\x07\xc2\x9b"
                    "31m"),
            "\\x1b[31mRED\\x07\\u009b31m");
  EXPECT_EQ(visible("a\rb\x7f"), "a\\x0db\\x7f");
  EXPECT_EQ(visible(std::string_view("\0x", 2)), "\\x00x");
  EXPECT_EQ(visible("\xe2\x80\xae"
                    "gnp.exe \xe2\x81\xa9"),
            "\\u202egnp.exe \\u2069");
}

TEST(Visible, SpellsWhatIsNoUtf8) {
  EXPECT_EQ(visible("\x9b"
                    "2J"),
            "\\x9b2J")
      << "one byte steers terminals that know no UTF-8";
  EXPECT_EQ(visible("\xc0\x9b"
                    "2J"),
            "\\xc0\\x9b2J")
      << "an escape in two bytes";
  EXPECT_EQ(visible("\xe2\x82"), "\\xe2\\x82");
  EXPECT_EQ(visible("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(visible("\xf4\x90\x80\x80\xff"), "\\xf4\\x90\\x80\\x80\\xff");
}

TEST(Visible, LeavesLettersOfAllLanguages) {
  for (const char* text :
       {"", "ECHO: \"a\"\n\tb", "\\x1b", "größe €uro 𝄞 عربى עברית 日本", "\xc2\xa0"})
    EXPECT_EQ(visible(text), text);
}

}  // namespace
}  // namespace frontend
