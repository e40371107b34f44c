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

}  // namespace
}  // namespace language
