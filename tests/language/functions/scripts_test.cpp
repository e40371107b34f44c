// Each script is what OpenSCAD 2021.01 writes for text() of the bytes.
#include "functions/scripts.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <utility>

namespace language {
namespace {

TEST(Scripts, BytesThatBeginNoCodePointHaveNone) {
  for (const auto& [text, script] :
       {std::pair<std::string_view, std::string_view>{"caf\xe9", "Latn"},
        {"\xe9", ""},
        {"\xe9qr", "Latn"},
        {"\xe9\xd7\x90", "Hebr"},
        {"\xf8\xd7\x90", "Hebr"},
        {"\xd7\xd7\x90", "Hebr"},
        {"a\xe9\xd7\x90", ""},
        {"\xed\xa0\x80z", "Latn"}}) {
    EXPECT_EQ(script_of(text), script) << text;
  }
}

}  // namespace
}  // namespace language
