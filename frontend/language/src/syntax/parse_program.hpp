// Reads and parses a design, and later the definitions that have only been preparsed.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/messages.hpp"
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

/// Makes the trees of definitions that have been preparsed.
class DefinitionReader {
 public:
  DefinitionReader(Program& program, Messages& messages, std::stop_token stop)
      : program_(program), messages_(messages), stop_(std::move(stop)) {}

  /// Returns what a definition of the program says. It is made at the first call, and stays with
  /// the definition. Throws Stopped.
  const FunctionDefinition::Content& content_of(const FunctionDefinition& function);
  const ModuleDefinition::Content& content_of(const ModuleDefinition& module);

 private:
  template <typename Definition, typename Parse>
  auto& content_of(const Definition& definition, Parse parse);

  Program& program_;
  Messages& messages_;  // gets none: the definition has been parsed before, without any
  std::stop_token stop_;
};

}  // namespace language
