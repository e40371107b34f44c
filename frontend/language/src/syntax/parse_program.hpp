// Reads and parses a design.
#pragma once

#include <cstdint>
#include <string>

#include "messages/messages.hpp"
#include "syntax/parse_options.hpp"
#include "syntax/program.hpp"

namespace language {

enum class ParseOutcome : uint8_t {
  kParsed,      // perhaps without some of the used files
  kNotParsed,   // a syntax error in the main file, or in what it includes
  kUnreadable,  // the main file
};

/// Fills an empty program with the design in the file `path` ("-": the standard input, whose text
/// the options have) and with the files that it uses. Says all that OpenSCAD says about them, in
/// its order, and tells `messages`, which must refer to program.files, the main file's folder.
/// Throws nothing but Stopped (language/stopped.hpp).
ParseOutcome parse_program(Program& program, Messages& messages, const std::string& path,
                           const ParseOptions& options);

}  // namespace language
