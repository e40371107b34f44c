// Tests the command that is made of an editor and a place.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <string>
#include <vector>

#include "editor.hpp"

namespace window {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const EditorPlace kPlace{"/a b/$c.scad", 12, 3};

std::vector<std::string> words(const std::string& editor) {
  const EditorCommand command = editor_command(editor, kPlace);
  EXPECT_EQ(command.problem, "");
  return command.words;
}

TEST(EditorCommand, FillsPlaceholders) {
  EXPECT_THAT(words("my-editor --at={line}:{column} {file} {column}{x}"),
              ElementsAre("my-editor", "--at=12:3", "/a b/$c.scad", "3{x}"));
  EXPECT_THAT(words("vim +{line} {file}"), ElementsAre("vim", "+12", "/a b/$c.scad"))
      << "whoever writes placeholders knows the editor";
}

/// A file may be named as a placeholder is.
TEST(EditorCommand, FillsEachPlaceholderOnce) {
  EXPECT_THAT(editor_command("e {file}", {"/{line}.scad", 1, 1}).words,
              ElementsAre("e", "/{line}.scad"));
}

TEST(EditorCommand, KnowsTheFormsOfEditors) {
  const std::string at = "/a b/$c.scad:12:3";
  EXPECT_THAT(words("code"), ElementsAre("code", "--goto", at));
  EXPECT_THAT(words("code -g"), ElementsAre("code", "-g", at));
  EXPECT_THAT(words("/usr/bin/code --reuse-window"),
              ElementsAre("/usr/bin/code", "--reuse-window", "--goto", at));
  EXPECT_THAT(words("subl"), ElementsAre("subl", at));
  EXPECT_THAT(words("emacsclient"),
              ElementsAre("emacsclient", "--no-wait", "+12:3", "/a b/$c.scad"));
  EXPECT_THAT(words("emacsclient -n -c"),
              ElementsAre("emacsclient", "-n", "-c", "+12:3", "/a b/$c.scad"));
  EXPECT_THAT(words("gvim"), ElementsAre("gvim", "+12", "/a b/$c.scad"));
  EXPECT_THAT(words("vim --remote"), ElementsAre("vim", "--remote", "+12", "/a b/$c.scad"));
  EXPECT_THAT(words("kate"), ElementsAre("kate", "--line", "12", "--column", "3", "/a b/$c.scad"));
  EXPECT_THAT(words("unheard-of"), ElementsAre("unheard-of", "/a b/$c.scad"));
}

TEST(EditorCommand, SplitsAsAShellDoesAndNoMore) {
  EXPECT_THAT(
      words("  'my editor' -x \"a 'b' \\\" c\" d\\ e $HOME `f` {file} ''"),
      ElementsAre("my editor", "-x", "a 'b' \" c", "d e", "$HOME", "`f`", "/a b/$c.scad", ""));
  const EditorCommand open = editor_command("code 'x", kPlace);
  EXPECT_THAT(open.words, IsEmpty());
  EXPECT_THAT(open.problem, HasSubstr("a quote has no end"));
}

TEST(EditorCommand, EditorsForTerminalsAreAProblem) {
  for (const char* editor : {"vim", "/usr/bin/nvim", "nano", "emacs -nw", "emacsclient -t"}) {
    const EditorCommand command = editor_command(editor, kPlace);
    EXPECT_THAT(command.words, IsEmpty()) << editor;
    EXPECT_THAT(command.problem, HasSubstr("needs a terminal")) << editor;
  }
  EXPECT_THAT(words("vim -g"), ElementsAre("vim", "-g", "+12", "/a b/$c.scad"));
}

TEST(EditorCommand, WithoutAnEditorItSaysWhatToDo) {
  EXPECT_THAT(editor_command(" ", kPlace).problem, HasSubstr("--editor=COMMAND"));
}

/// Sets variables for one test.
class EditorVariables : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"SCADRAY_EDITOR", "VISUAL", "EDITOR"}) unsetenv(name);
  }
};

TEST_F(EditorVariables, TheNearestOneCounts) {
  EXPECT_EQ(chosen_editor(""), "");
  setenv("EDITOR", "ed", 1);
  EXPECT_EQ(chosen_editor(""), "ed");
  setenv("VISUAL", "", 1);
  EXPECT_EQ(chosen_editor(""), "ed");
  setenv("VISUAL", "kate", 1);
  EXPECT_EQ(chosen_editor(""), "kate");
  setenv("SCADRAY_EDITOR", "subl", 1);
  EXPECT_EQ(chosen_editor(""), "subl");
  EXPECT_EQ(chosen_editor("code"), "code");
}

}  // namespace
}  // namespace window
