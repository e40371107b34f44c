#include "messages/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace language {
namespace {

class MessagesTest : public testing::Test {
 protected:
  MessagesTest() {
    messages.set_main_file(kNoFile, "/designs/main");
    messages.set_unit_folder("/designs/library");
  }

  SourceFiles files;
  std::vector<std::string> lines;
  Messages messages{files, [this](const Message& message) { lines.push_back(message.line); }};
  FileId file = files.add("/designs/library/a.scad", "x\ny");
};

using Lines = std::vector<std::string>;

TEST_F(MessagesTest, ShowPathsRelativeToAFolder) {
  const Place place{file, 2};
  messages.warn("one", place);
  messages.warn("two", place, PathBase::kUnit);
  messages.say(MessageGroup::kEcho, "3");
  messages.say(MessageGroup::kPlain, "");
  EXPECT_EQ(lines, (Lines{"WARNING: one in file ../library/a.scad, line 2",
                          "WARNING: two in file a.scad, line 2", "ECHO: 3", ""}));
}

TEST_F(MessagesTest, ShowTheStandardInputByItsName) {
  const FileId input = files.add("<stdin>", "x");
  messages.warn("one", {input, 0});
  messages.say_parser_error("two", {input, 0}, 7);
  EXPECT_EQ(lines,
            (Lines{"WARNING: one in file <stdin>, line 1", "ERROR: two in file <stdin>, line 7"}));
}

TEST_F(MessagesTest, DropWhatEqualsTheLastFive) {
  for (int i = 0; i < 7; ++i) {
    messages.warn("same");
    messages.say(MessageGroup::kEcho, "between");
  }
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "WARNING: same"), 5);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "ECHO: between"), 7);
  EXPECT_EQ(messages.warnings(), 7u);
  messages.say(MessageGroup::kTrace, "other");
  messages.warn("same");
  EXPECT_EQ(lines.back(), "WARNING: same");
}

TEST_F(MessagesTest, SayDeprecationsOncePerPlace) {
  for (const uint32_t offset : {0u, 1u, 2u, 0u}) {
    messages.say(MessageGroup::kDeprecated, "old", {file, offset}, PathBase::kUnit);
  }
  EXPECT_EQ(lines, (Lines{"DEPRECATED: old in file a.scad, line 1",
                          "DEPRECATED: old in file a.scad, line 2"}));
}

}  // namespace
}  // namespace language
