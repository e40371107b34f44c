#include "language/source_files.hpp"

#include <gtest/gtest.h>

namespace language {
namespace {

TEST(SourceFiles, CountsLinesAndColumns) {
  SourceFiles files;
  const FileId file = files.add({"/a.scad", "ab\r\ncd\n", {3, 4, 7}});
  EXPECT_EQ(files.message_line({file, 0}), 1u);
  EXPECT_EQ(files.message_line({file, 3}), 2u);
  EXPECT_EQ(files.message_line({file, 5}), 3u);
  EXPECT_EQ(files.line({file, 3}), 1u);
  EXPECT_EQ(files.line({file, 5}), 2u);
  EXPECT_EQ(files.column({file, 0}), 1u);
  EXPECT_EQ(files.column({file, 1}), 2u);
  EXPECT_EQ(files.column({file, 5}), 2u);
  EXPECT_EQ(files.line({file, 7}), 3u);
  EXPECT_EQ(files.column({file, 7}), 1u);
}

}  // namespace
}  // namespace language
