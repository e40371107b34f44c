// Writes the options' part of a program's manual page and completions, from its option table.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "command/option_row.hpp"

namespace packaging {

struct OptionGroup {
  const char* title;
  std::span<const frontend::OptionRow> rows;
};

struct Program {
  const char* name;
  const char* subcommands;  // names of its subcommands, which run NAME-SUBCOMMAND, separated by
                            // spaces
  std::vector<OptionGroup> groups;
};

/// The program's name, in a form that may be part of a shell function's name.
std::string function_of(const Program& program);

/// The spellings of an option that users are told: "-q" and "--quiet"; only "-o", although "--o" is
/// understood, too.
std::vector<std::string> spellings(const frontend::OptionRow& row);

/// A short description of the option: its help up to the first semicolon.
std::string brief_of(const frontend::OptionRow& row);

/// The text with a backslash before each of the characters.
std::string escaped(const std::string& text, const char* characters);

/// The options' part of each file, in the file's language.
std::string manual_options(const Program& program);
std::string bash_options(const Program& program);
std::string zsh_options(const Program& program);
std::string fish_options(const Program& program);

}  // namespace packaging
