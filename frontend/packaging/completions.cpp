// Writes the options' part of the shells' completions: one line of the shell's language per option.
#include "program.hpp"

namespace packaging {
namespace {

using frontend::Completion;
using frontend::OptionRow;
using frontend::Takes;

using Kind = Completion::Kind;

std::string joined(const std::vector<std::string>& parts, const char* separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

/// Returns the row's words, each quoted for the shell, separated by spaces.
std::string quoted_words(const OptionRow& row) {
  std::vector<std::string> quoted;
  for (const std::string& word : row.completion.words()) quoted.push_back(escaped(word, " '\\"));
  return joined(quoted, " ");
}

/// Escapes a text for a place within single quotes of a POSIX shell.
std::string in_single_quotes(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result;
}

template <typename LineOf>
std::string lines(const Program& program, LineOf line_of) {
  std::string text;
  for (const OptionGroup& group : program.groups) {
    for (const OptionRow& row : group.rows) text += line_of(row);
  }
  return text;
}

/// Returns zsh's _arguments action that completes the option's value.
std::string zsh_action(const OptionRow& row) {
  switch (row.completion.kind) {
    case Kind::kNothing:
      return " ";
    case Kind::kFiles:
      return "_files";
    case Kind::kCommands:
      return "_command_names -e";
    case Kind::kWord:
      return "(" + quoted_words(row) + ")";
    case Kind::kWordList:
      return "_sequence compadd - " + quoted_words(row);
  }
  return "";
}

std::string zsh_line(const OptionRow& row) {
  const std::vector<std::string> names = spellings(row);
  std::string value;
  if (row.takes != Takes::kNothing) {
    value = std::string(row.takes == Takes::kOptionalText ? "::" : ":") +
            escaped(row.value_name, ":") + ":" + zsh_action(row);
  }
  std::string text;
  for (const std::string& name : names) {
    // An option and its other spelling exclude each other; an option that may be repeated excludes
    // nothing.
    const std::string before =
        row.takes == Takes::kTexts ? "*" : (names.size() > 1 ? "(" + joined(names, " ") + ")" : "");
    const char* after = row.takes == Takes::kNothing ? "" : (name.size() > 2 ? "=" : "+");
    text += "    '" +
            in_single_quotes(before + name + after + "[" + escaped(brief_of(row), "[]:\\") + "]" +
                             value) +
            "'\n";
  }
  return text;
}

/// Returns what the bash function of the template offers for the value.
std::string bash_action(const OptionRow& row) {
  switch (row.completion.kind) {
    case Kind::kNothing:
      return "kind=nothing";
    case Kind::kFiles:
      return "kind=files";
    case Kind::kCommands:
      return "kind=commands";
    case Kind::kWord:
      return "kind=words words=(" + quoted_words(row) + ")";
    case Kind::kWordList:
      return "kind=list words=(" + quoted_words(row) + ")";
  }
  return "";
}

std::string bash_line(const OptionRow& row) {
  if (row.takes == Takes::kNothing) return "";
  return "    " + joined(spellings(row), " | ") + ") " + bash_action(row) + " ;;\n";
}

std::string fish_line(const Program& program, const OptionRow& row) {
  std::string text = "__" + function_of(program) + "_option";
  for (const std::string& name : spellings(row)) {
    text += name.size() == 2 ? " -s " + name.substr(1) : " -l " + name.substr(2);
  }
  const auto argument = [](const std::string& value) { return "'" + escaped(value, "'\\") + "'"; };
  if (row.takes != Takes::kNothing) {
    switch (row.completion.kind) {
      case Kind::kNothing:
        text += " -x";
        break;
      case Kind::kFiles:
        text += " -r -F";
        break;
      case Kind::kCommands:
        text += " -x -a '(__fish_complete_command)'";
        break;
      case Kind::kWord:
        text += " -x -a " + argument(quoted_words(row));
        break;
      case Kind::kWordList:
        text += " -x -a " + argument("(__fish_append , " + quoted_words(row) + ")");
        break;
    }
  }
  return text + " -d " + argument(brief_of(row)) + "\n";
}

}  // namespace

std::string bash_options(const Program& program) {
  std::vector<std::string> names;
  lines(program, [&names](const OptionRow& row) {
    for (const std::string& name : spellings(row)) names.push_back(name);
    return std::string();
  });
  return "  local options='" + joined(names, " ") + "'\n  case $option in\n" +
         lines(program, bash_line) + "  esac\n";
}

std::string zsh_options(const Program& program) { return lines(program, zsh_line); }

std::string fish_options(const Program& program) {
  return lines(program, [&program](const OptionRow& row) { return fish_line(program, row); });
}

}  // namespace packaging
