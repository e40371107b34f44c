#include "language/source_files.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace language {
namespace {

TEST(SourceFiles, CountsLinesAndColumns) {
  SourceFiles files;
  const FileId file = files.add("/a.scad", "ab\r\ncd\n");
  EXPECT_EQ(files.line({file, 3}), 1u);
  EXPECT_EQ(files.line({file, 5}), 2u);
  EXPECT_EQ(files.column({file, 0}), 1u);
  EXPECT_EQ(files.column({file, 1}), 2u);
  EXPECT_EQ(files.column({file, 5}), 2u);
  EXPECT_EQ(files.line({file, 7}), 3u);
  EXPECT_EQ(files.column({file, 7}), 1u);
}

TEST(SourceFiles, CountMessageLinesAsTheLexerSays) {
  SourceFiles files;
  const FileId file = files.add("/a.scad", "ab\r\ncd\nef\n");
  const auto lines = [&] {
    std::vector<uint32_t> of_offsets;
    for (uint32_t offset = 0; offset < 10; ++offset) {
      of_offsets.push_back(files.message_line({file, offset}));
    }
    return of_offsets;
  };
  EXPECT_EQ(lines(), (std::vector<uint32_t>{1, 1, 1, 1, 2, 2, 2, 3, 3, 3}));
  files[file].note_counted_return(2);
  EXPECT_EQ(lines(), (std::vector<uint32_t>{1, 1, 1, 2, 3, 3, 3, 4, 4, 4}));
  files[file].note_counted_return(2);  // the file is included once more
  files[file].note_uncounted_feed(6);
  EXPECT_EQ(lines(), (std::vector<uint32_t>{1, 1, 1, 2, 3, 3, 3, 3, 3, 3}));
}

}  // namespace
}  // namespace language
