// Tests how the lines of an evaluation become the messages of the panel.
#include "message_list.hpp"

#include <gmock/gmock.h>

namespace window {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

std::vector<std::string> texts_of(const std::vector<MessageLine>& lines) {
  std::vector<std::string> texts;
  for (const MessageLine& line : lines) texts.push_back(line.text);
  return texts;
}

TEST(MessageList, FindsThePlaceOfOpenScadsMessages) {
  const MessagePlace place =
      place_of_message("WARNING: Ignoring unknown variable 'x', in file a, line 1.scad, line 12");
  EXPECT_EQ(place.file, "a, line 1.scad");
  EXPECT_EQ(place.line, 12u);
  EXPECT_EQ(place.column, 0u);
  EXPECT_EQ(
      place_of_message("ERROR: Parser error in file \"/tmp/b.scad\", line 3: syntax error").file,
      "/tmp/b.scad");
}

TEST(MessageList, FindsThePlaceOfScadraysMessages) {
  const MessagePlace place = place_of_message("c:d.scad:4:9: error: no such file (look for it)");
  EXPECT_EQ(place.file, "c:d.scad");
  EXPECT_EQ(place.line, 4u);
  EXPECT_EQ(place.column, 9u);
  EXPECT_TRUE(place.is_from_here);
}

/// An error that ends the evaluation has a line alone.
TEST(MessageList, FindsThePlaceOfAnErrorWithoutAColumn) {
  const MessagePlace place = place_of_message("lib/bad.scad:2: error: Assertion 'a:3: b' failed");
  EXPECT_EQ(place.file, "lib/bad.scad");
  EXPECT_EQ(place.line, 2u);
  EXPECT_EQ(place.column, 0u);
}

TEST(MessageList, TakesThePlacesThatAreKnown) {
  const std::vector<Message> messages = messages_of(
      {"WARNING: w in file x.scad, line 1", "TRACE: called by 'f' in file x.scad, line 2",
       "WARNING: w in file x.scad, line 1", "ECHO: \"in file x.scad, line 3\""},
      {{"/a/lib/x.scad", "x.scad", 1, 7}, {"/a/x.scad", "x.scad", 2, 3}, {}, {"/a", "a", 1, 1}});
  ASSERT_THAT(messages, SizeIs(3)) << "equal texts of two files are two messages";
  EXPECT_EQ(messages[0].place, (MessagePlace{"/a/lib/x.scad", 1, 7}));
  EXPECT_EQ(messages[0].traces.front().place, (MessagePlace{"/a/x.scad", 2, 3}));
  EXPECT_EQ(messages[1].place, (MessagePlace{"x.scad", 1, 0}));
  EXPECT_EQ(messages[2].place, MessagePlace{});
}

TEST(MessageList, PutsTheErrorFirstWithItsTraces) {
  frontend::DesignVersion version;
  version.error = "d.scad:1: error: boom";
  version.messages = {"WARNING: foo",         "TRACE: called by 'a'", "WARNING: x",
                      "TRACE: called by 'b'", "TRACE: called by 'c'", "WARNING: y"};
  version.places.resize(5);
  version.places[3] = {"/d.scad", "d.scad", 4, 5};
  version.before_error = 3;
  const std::vector<Message> messages = messages_of(version);
  ASSERT_THAT(messages, SizeIs(4));
  EXPECT_EQ(messages[0].text, version.error);
  EXPECT_THAT(texts_of(messages[0].traces),
              ElementsAre("TRACE: called by 'b'", "TRACE: called by 'c'"));
  EXPECT_EQ(messages[0].traces[0].place.line, 4u);
  EXPECT_THAT(texts_of(messages[1].traces), ElementsAre("TRACE: called by 'a'"));
  EXPECT_EQ(messages[2].text, "WARNING: x");
  EXPECT_THAT(messages[2].traces, testing::IsEmpty());
  EXPECT_EQ(messages[3].text, "WARNING: y");
}

TEST(MessageList, NamesNoPlaceWhereThereIsNone) {
  EXPECT_EQ(place_of_message("ECHO: \"in file x, line 3\"").file, "");
  EXPECT_EQ(place_of_message("WARNING: Viewall and autocenter disabled").file, "");
  EXPECT_EQ(place_of_message("WARNING: x, in file a.scad, line none").file, "");
  EXPECT_EQ(place_of_message("12:30:15: time").file, "");
}

TEST(MessageList, TellsKindsApart) {
  const auto kind = [](const char* line) { return messages_of({line}).front().kind; };
  EXPECT_EQ(kind("ERROR: Assertion 'false' failed in file a.scad, line 1"), MessageKind::kError);
  EXPECT_EQ(kind("a.scad:1:1: error: out of memory (try a smaller design)"), MessageKind::kError);
  EXPECT_EQ(kind("WARNING: undefined operation, in file a.scad, line 1"), MessageKind::kWarning);
  EXPECT_EQ(kind("DEPRECATED: child() will be removed, in file a, line 1"), MessageKind::kWarning);
  EXPECT_EQ(kind("a.scad:1:1: warning: left out (…)"), MessageKind::kWarning);
  EXPECT_EQ(kind("ECHO: \"WARNING: mine\""), MessageKind::kEcho);
  EXPECT_EQ(kind("Saved"), MessageKind::kOther);
}

// What is copied from the panel may be pasted into a terminal.
TEST(MessageList, ShowsControlCharacters) {
  const Message message = messages_of({"WARNING: \x1b[2J in file a\x07.scad, line 2",
                                       "TRACE: called by '\x1b', in file x, line 2"})[0];
  EXPECT_EQ(message.text, "WARNING: \\x1b[2J in file a\\x07.scad, line 2");
  ASSERT_EQ(message.traces.size(), 1u);
  EXPECT_EQ(message.traces[0].text, "TRACE: called by '\\x1b', in file x, line 2");
  EXPECT_EQ(message.place.file, "a\x07.scad") << "which the editor opens";
}

TEST(MessageList, FoldsWhatRepeatsWithItsTraces) {
  const std::vector<Message> messages = messages_of({
      "WARNING: a, in file x, line 1",
      "TRACE: called by 'f', in file x, line 2",
      "WARNING: b, in file x, line 1",
      "WARNING: a, in file x, line 1",
      "TRACE: called by 'f', in file x, line 2",
      "WARNING: a, in file x, line 1",
      "TRACE: called by 'g', in file x, line 3",
  });
  ASSERT_THAT(messages, SizeIs(3));
  EXPECT_EQ(messages[0].count, 2u);
  EXPECT_THAT(texts_of(messages[0].traces), ElementsAre("TRACE: called by 'f', in file x, line 2"));
  EXPECT_EQ(messages[1].count, 1u);
  EXPECT_THAT(texts_of(messages[2].traces), ElementsAre("TRACE: called by 'g', in file x, line 3"));
}

TEST(MessageList, KeepsTheOrderOfEchoes) {
  const std::vector<Message> messages =
      messages_of({"ECHO: 1", "ECHO: 1", "ECHO: 2", "WARNING: w", "ECHO: 1"});
  ASSERT_THAT(messages, SizeIs(4));
  EXPECT_EQ(messages[0].count, 2u);
  EXPECT_EQ(messages[3].text, "ECHO: 1");
}

TEST(MessageList, CountsAndFilters) {
  const std::vector<Message> messages =
      messages_of({"ECHO: 1", "WARNING: Wide", "TRACE: by 'Module'", "WARNING: w", "WARNING: w"});
  const MessageCounts counts = count_messages(messages);
  EXPECT_EQ(counts.echoes, 1u);
  EXPECT_EQ(counts.warnings, 3u);
  EXPECT_EQ(counts.without_echoes(), 3u);
  EXPECT_TRUE(contains(messages[1], "wide"));
  EXPECT_TRUE(contains(messages[1], "MODULE"));
  EXPECT_FALSE(contains(messages[2], "wide"));
}

}  // namespace
}  // namespace window
