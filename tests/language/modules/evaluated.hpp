// Evaluates a design's text for the tests of builtin modules.
#pragma once

#include <string>
#include <string_view>

#include "language/csg_writer.hpp"
#include "language/evaluation.hpp"

namespace language_test {

struct Evaluated {
  std::string csg;       // without the empty line at its end
  std::string messages;  // a line each
};

inline Evaluated evaluated(std::string_view text, const language::EvaluationOptions& options = {}) {
  Evaluated result;
  const language::Evaluation evaluation = language::evaluate(
      "-", options, [&](std::string_view line) { result.messages.append(line) += '\n'; }, text);
  result.csg = language::csg_text(*evaluation.tree);
  result.csg.pop_back();
  return result;
}

}  // namespace language_test
