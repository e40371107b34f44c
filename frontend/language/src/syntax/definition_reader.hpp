// Makes the trees of definitions that have been preparsed.
#pragma once

#include <stop_token>
#include <utility>

#include "messages/messages.hpp"
#include "syntax/program.hpp"

namespace language {

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
