#include "base/name_list.hpp"

#include <gtest/gtest.h>

namespace language {
namespace {

TEST(NameList, FindsFewAndManyNames) {
  NameList list;
  for (uint32_t i = 0; i < 40; ++i) {
    EXPECT_EQ(list.find(3 * i), NameList::kNone);
    EXPECT_EQ(list.add(3 * i), i);
    for (uint32_t known = 0; known <= i; ++known) {
      EXPECT_EQ(list.find(3 * known), known);
      EXPECT_EQ(list.add(3 * known), known);
    }
    EXPECT_EQ(list.size(), i + 1);
  }
}

}  // namespace
}  // namespace language
