// Opens places in the user's editor.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "editor_command.hpp"

namespace window {

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
