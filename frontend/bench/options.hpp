// The command line of scadray-bench.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "command/option_row.hpp"
#include "frontend/camera.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/importer.hpp"
#include "frontend/run_program.hpp"
#include "measurement.hpp"

namespace bench {

/// The checked command line: every value is in its documented range.
struct Options : frontend::ReadingOptions {
  frontend::ProgramRequest request{};
  std::vector<std::string> inputs;  // at least one; "-", at most once: standard input
  frontend::CameraOptions camera;
  Settings settings;
  bool json = false;
  bool quiet = false;
};

/// Parses the arguments (without the program's name). Throws frontend::Error for any that is wrong.
Options parse_options(const std::vector<std::string>& arguments);

/// Returns the text of --help.
std::string help_text();

/// Returns the option table, for the manual page and the completions, too (frontend/packaging).
std::span<const frontend::OptionRow> option_rows();

}  // namespace bench
