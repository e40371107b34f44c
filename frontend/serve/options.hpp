// The command line of scadray-serve.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "command/option_row.hpp"
#include "language/language_version.hpp"

namespace serve {

enum class Action : uint8_t { kServe, kHelp, kVersion };

struct Options {
  Action action = Action::kServe;
  language::LanguageVersion language{};
};

/// Parses the arguments (without the program's name). Throws frontend::Error for any that is wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// Returns the text of --help.
std::string help_text();

/// Returns the option table, for the manual page and the completions, too (frontend/packaging).
std::span<const frontend::OptionRow> option_rows();

}  // namespace serve
