#include "editor.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "process/spawn.hpp"

namespace window {
namespace {

constexpr std::array<std::string_view, 3> kPlaceholders{"{file}", "{line}", "{column}"};

/// How an editor is told the place.
struct EditorForm {
  std::string_view arguments;           // with placeholders, and a blank between two
  std::vector<std::string_view> names;  // of programs
};

const std::vector<EditorForm>& editor_forms() {
  static const std::vector<EditorForm> forms = {
      {"--goto {file}:{line}:{column}",
       {"code", "code-insiders", "code-oss", "codium", "vscodium", "cursor", "windsurf"}},
      {"{file}:{line}:{column}",
       {"subl", "sublime_text", "zed", "zeditor", "geany", "lite-xl", "pulsar", "lapce"}},
      {"--no-wait +{line}:{column} {file}", {"emacsclient"}},
      {"+{line}:{column} {file}", {"emacs", "gedit", "gnome-text-editor", "pluma", "xed"}},
      {"+{line} {file}", {"gvim", "mvim", "neovide", "nvim-qt"}},
      {"--line {line} --column {column} {file}",
       {"kate", "kwrite", "kdevelop", "mousepad", "idea", "clion", "pycharm"}},
  };
  return forms;
}

/// Editors that draw in a terminal, unless they are told to open a window.
constexpr std::string_view kInTerminals[] = {"vi",     "vim",   "nvim", "view",  "nano", "pico",
                                             "hx",     "helix", "kak",  "micro", "joe",  "ne",
                                             "mcedit", "ed",    "jed",  "mg",    "zile", "ex"};

bool is_one_of(std::string_view name, const auto& names) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool has_any(const std::vector<std::string>& words,
             std::initializer_list<std::string_view> wanted) {
  return std::any_of(words.begin() + 1, words.end(),
                     [&](const std::string& word) { return is_one_of(word, wanted); });
}

/// Splits a command line at blanks outside of quotes; nothing if a quote has no end.
std::optional<std::vector<std::string>> words_of(std::string_view line) {
  std::vector<std::string> words;
  bool is_in_word = false;
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      is_in_word = false;
      continue;
    }
    if (!is_in_word) words.emplace_back();
    is_in_word = true;
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == '\\' && quote != '\'' && i + 1 < line.size()) {
      words.back() += line[++i];
    } else {
      words.back() += c;
    }
  }
  return quote == 0 ? std::optional(std::move(words)) : std::nullopt;
}

std::string with_place(std::string_view word, const EditorPlace& place) {
  const std::string values[] = {place.path, std::to_string(place.line),
                                std::to_string(place.column)};
  std::string result;
  while (!word.empty()) {
    std::size_t found = 0;
    while (found < kPlaceholders.size() && !word.starts_with(kPlaceholders[found])) ++found;
    if (found < kPlaceholders.size()) {
      result += values[found];
      word.remove_prefix(kPlaceholders[found].size());
    } else {
      result += word.front();
      word.remove_prefix(1);
    }
  }
  return result;
}

bool has_placeholder(const std::string& word) {
  return std::any_of(kPlaceholders.begin(), kPlaceholders.end(), [&](std::string_view placeholder) {
    return word.find(placeholder) != std::string::npos;
  });
}

/// Returns the arguments that tell the editor the place, with placeholders.
std::string_view place_arguments(std::string_view program, const std::vector<std::string>& words) {
  // To a running editor, which takes no columns.
  if (has_any(words, {"--remote", "--remote-silent", "--remote-tab", "--remote-tab-silent"})) {
    return "+{line} {file}";
  }
  for (const EditorForm& form : editor_forms()) {
    if (is_one_of(program, form.names)) return form.arguments;
  }
  return is_one_of(program, kInTerminals) ? "+{line} {file}" : "{file}";
}

/// Returns whether the command draws in a terminal.
bool needs_terminal(std::string_view program, const std::vector<std::string>& words) {
  if (program == "emacs" || program == "emacsclient") {
    return has_any(words, {"-nw", "-t", "-tty", "--tty", "--no-window-system"});
  }
  return is_one_of(program, kInTerminals) &&
         !has_any(words,
                  {"-g", "--remote", "--remote-silent", "--remote-tab", "--remote-tab-silent"});
}

}  // namespace

std::string chosen_editor(const std::string& option) {
  if (!option.empty()) return option;
  for (const char* const name : {"SCADRAY_EDITOR", "VISUAL", "EDITOR"}) {
    const char* const value = std::getenv(name);
    if (value != nullptr && *value != '\0') return value;
  }
  return {};
}

EditorCommand editor_command(const std::string& editor, const EditorPlace& place) {
  const std::optional<std::vector<std::string>> typed = words_of(editor);
  if (!typed) return {{}, "--editor: a quote has no end: " + editor};
  if (typed->empty()) {
    return {{}, "no editor is set (start scadray with --editor=COMMAND, or set SCADRAY_EDITOR)"};
  }
  std::vector<std::string> words = *typed;
  const bool names_place = std::any_of(words.begin(), words.end(), has_placeholder);
  if (!names_place) {
    const std::string program = words[0].substr(words[0].rfind('/') + 1);  // npos + 1 = 0
    if (needs_terminal(program, words)) {
      return {{},
              program +
                  " needs a terminal (give one that has a window: --editor='code', or "
                  "--editor='xterm -e " +
                  program + " +{line} {file}')"};
    }
    std::string_view rest = place_arguments(program, words);
    if (rest.starts_with("--goto ") && has_any(words, {"-g", "--goto"})) rest.remove_prefix(7);
    if (rest.starts_with("--no-wait ") && has_any(words, {"-n", "--no-wait"})) {
      rest.remove_prefix(10);
    }
    while (!rest.empty()) {
      const std::size_t blank = std::min(rest.find(' '), rest.size());
      words.emplace_back(rest.substr(0, blank));
      rest.remove_prefix(std::min(blank + 1, rest.size()));
    }
  }
  for (std::string& word : words) word = with_place(word, place);
  return {std::move(words), {}};
}

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
