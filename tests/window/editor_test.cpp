// Tests the start of an editor, and what is said of it.
#include "editor.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <future>
#include <string>
#include <thread>

#include "temporary_folder.hpp"

namespace window {
namespace {

using testing::HasSubstr;

constexpr std::chrono::seconds kPatience{60};

class EditorTest : public testing::Test {
 protected:
  const frontend::TemporaryFolder folder_;
  const EditorPlace place_{"/folder/a.scad", 12, 3};
};

TEST_F(EditorTest, SaysThatAnEditorHasFailed) {
  std::promise<void> news;
  Editor editor(folder_.script("edit", "exit 3"), [&news] { news.set_value(); });
  EXPECT_THAT(editor.open(place_), HasSubstr("edit opens /folder/a.scad:12"));
  ASSERT_EQ(news.get_future().wait_for(kPatience), std::future_status::ready);
  EXPECT_THAT(editor.take_problem().value_or(""), HasSubstr("has failed with exit code 3"));
  EXPECT_FALSE(editor.take_problem()) << "once";
}

TEST_F(EditorTest, SaysThatItCannotBeStarted) {
  Editor editor(folder_ / "missing", [] {});
  EXPECT_THAT(editor.open(place_), HasSubstr("missing cannot be started: "));
}

/// It waits for neither its editors, nor do they for it.
TEST_F(EditorTest, EndsBeforeItsEditors) {
  const std::string pipe = folder_ / "pipe";
  const std::string script =
      folder_.script("edit", "read line < " + pipe + "; echo $line > " + pipe + ".out; exit 1");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  {
    Editor editor(script, [] { ADD_FAILURE() << "there is nobody to tell"; });
    editor.open(place_);
  }
  std::ofstream(pipe) << "done\n";
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (folder_.read("pipe.out") != "done\n" && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(folder_.read("pipe.out"), "done\n");
}

}  // namespace
}  // namespace window
