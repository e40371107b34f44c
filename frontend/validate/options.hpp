// The command line of scadray-validate. Neither this file nor options.cpp needs CGAL.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "command/option_row.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/importer.hpp"
#include "frontend/run_program.hpp"
#include "validation.hpp"

namespace validation {

/// The checked command line: every value is in its documented range.
struct Options : frontend::ReadingOptions {
  frontend::ProgramRequest request{};
  std::string input;   // "-": standard input
  std::string report;  // empty: none; "-": standard output
  Settings settings;
  unsigned threads = 0;  // 0: as many as the machine has
  bool quiet = false;
};

/// Parses the arguments (without the program's name). Throws frontend::Error for any that is wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// Returns the text of --help.
std::string help_text();

/// Returns the option table, for the manual page and the completions, too (frontend/packaging).
std::span<const frontend::OptionRow> option_rows();

}  // namespace validation
