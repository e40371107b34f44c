#include "base/name_table.hpp"

#include <gtest/gtest.h>

namespace language {
namespace {

TEST(NameTable, StoresEachNameOnce) {
  NameTable names;
  const Name first = names.intern("width");
  EXPECT_EQ(names.intern("width"), first);
  EXPECT_NE(names.intern("$fn"), first);
  EXPECT_EQ(names.text(first), "width");
  EXPECT_EQ(names.find("height"), kNoName);
}

TEST(NameTable, KnowsDynamicNames) {
  NameTable names;
  EXPECT_TRUE(names.is_dynamic(names.intern("$fn")));
  EXPECT_FALSE(names.is_dynamic(names.intern("fn")));
}

TEST(NameTable, HoldsManyNames) {
  NameTable names;
  constexpr Name kCount = 5000;
  for (Name i = 0; i < kCount; ++i) EXPECT_EQ(names.intern("name_" + std::to_string(i)), i);
  for (Name i = 0; i < kCount; ++i) EXPECT_EQ(names.find("name_" + std::to_string(i)), i);
  EXPECT_EQ(names.size(), kCount);
}

TEST(NameTable, TellsNamesApartAtEachByte) {
  NameTable names;
  Name count = 0;
  for (size_t length = 1; length <= 20; ++length) {
    EXPECT_EQ(names.intern(std::string(length, 'a')), count++);
    for (size_t i = 0; i < length; ++i) {
      std::string name(length, 'a');
      name[i] = 'b';
      EXPECT_EQ(names.intern(name), count++);
    }
  }
}

}  // namespace
}  // namespace language
