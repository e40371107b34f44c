// The command line of scadray-serve.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "command/option_row.hpp"
#include "frontend/run_program.hpp"
#include "language/language_version.hpp"

namespace serve {

struct Options {
  frontend::ProgramRequest request{};
  language::LanguageVersion language{};
  std::string design;  // to be shown to browsers; empty: the client is an editor
  uint16_t port = 0;   // 0: any
  std::string bind = "127.0.0.1";
  std::string origin;  // empty: that of `bind`
  std::string panel;   // a folder; empty: that beside the program
};

/// Parses the arguments (without the program's name). Throws frontend::Error for any that is wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// Returns the text of --help.
std::string help_text();

/// Returns the option table, for the manual page and the completions, too (frontend/packaging).
std::span<const frontend::OptionRow> option_rows();

}  // namespace serve
