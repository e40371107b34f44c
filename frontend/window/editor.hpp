// Opens places in the user's editor, by a command that the user or the environment names.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace window {

struct EditorPlace {
  std::string path;     // absolute
  uint32_t line = 1;    // from 1
  uint32_t column = 1;  // in characters, from 1
};

struct EditorCommand {
  std::vector<std::string> words;  // the program and its arguments; empty: there is a problem
  std::string problem;             // and what to do
};

/// Returns the editor that is to be used: `option`, or the first of $SCADRAY_EDITOR, $VISUAL and
/// $EDITOR that is set; empty if none is.
std::string chosen_editor(const std::string& option);

/// Returns the words that `editor` is started with. It is a command line, in which quotes and
/// backslashes mean what they mean to a shell, and nothing else does. {file}, {line} and {column}
/// stand for the place; where the line has none of them, an editor that is known by its name gets
/// the place in its own form, and any other the file alone. Editors for terminals are a problem: a
/// window has none for them.
EditorCommand editor_command(const std::string& editor, const EditorPlace& place);

class Editor {
 public:
  /// `command` is that of --editor; empty: the environment tells it. `on_news` is called from any
  /// thread when take_problem() has something; it must not block.
  Editor(const std::string& command, std::function<void()> on_news);
  /// Editors that are open stay open.
  ~Editor();
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  /// Starts the editor, and returns what there is to say of it. Does not wait.
  std::string open(const EditorPlace& place);
  /// Returns, once, that an editor has failed after it was started.
  std::optional<std::string> take_problem();

 private:
  struct News;
  const std::string command_;
  const std::shared_ptr<News> news_;  // the threads that wait for editors share it
};

}  // namespace window
