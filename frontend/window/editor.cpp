#include "editor.hpp"

#include <mutex>
#include <system_error>
#include <utility>

#include "process/start_program.hpp"

namespace window {

struct Editor::News {
  std::mutex mutex;
  std::function<void()> on_news;
  std::optional<std::string> problem;

  void take_end(const std::string& program, int exit_code) {
    const std::lock_guard lock(mutex);
    if (exit_code == 0 || !on_news) return;
    problem = program + " has failed with exit code " + std::to_string(exit_code) +
              " (see that --editor is right)";
    on_news();
  }
};

Editor::Editor(const std::string& command, std::function<void()> on_news)
    : command_(chosen_editor(command)), news_(std::make_shared<News>()) {
  news_->on_news = std::move(on_news);
}

Editor::~Editor() {
  const std::lock_guard lock(news_->mutex);
  news_->on_news = nullptr;
}

std::string Editor::open(const EditorPlace& place) {
  const EditorCommand command = editor_command(command_, place);
  if (!command.problem.empty()) return command.problem;
  const std::string& program = command.words.front();
  try {
    frontend::start_program(command.words, [news = news_, program](int exit_code) {
      news->take_end(program, exit_code);
    });
  } catch (const std::system_error& error) {
    return program + " cannot be started: " + error.code().message() +
           " (give another --editor=COMMAND)";
  }
  return program + " opens " + place.path + ":" + std::to_string(place.line);
}

std::optional<std::string> Editor::take_problem() {
  const std::lock_guard lock(news_->mutex);
  return std::exchange(news_->problem, std::nullopt);
}

}  // namespace window
