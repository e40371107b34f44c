#include "frontend/error.hpp"

#include <utility>

namespace frontend {
namespace {

/// Returns "file:line:column: severity: what (todo)", without the parts that are empty or 0.
std::string message(const Problem& problem, const char* severity) {
  const Location location = problem.location;
  std::string text = problem.file;
  if (location.line > 0) {
    if (!text.empty()) text += ':';
    text += std::to_string(location.line);
    if (location.column > 0) text += ':' + std::to_string(location.column);
  }
  if (!text.empty()) text += ": ";
  text += severity;
  text += ": " + problem.what;
  if (!problem.todo.empty()) text += " (" + problem.todo + ')';
  return text;
}

}  // namespace

Error::Error(const std::string& file, Location location, const std::string& what,
             const std::string& todo)
    : Error(Problem{file, location, what, todo}) {}

Error::Error(const Warning& warning)
    : std::runtime_error(warning.error_text),
      problem_(std::make_shared<const Problem>(warning.problem)) {}

Error::Error(Problem problem)
    : std::runtime_error(message(problem, "error")),
      problem_(std::make_shared<const Problem>(std::move(problem))) {}

Warning make_warning(const std::string& file, Location location, const std::string& what,
                     const std::string& todo) {
  const Problem problem{file, location, what, todo};
  return {message(problem, "warning"), message(problem, "error"), false, problem};
}

Warning make_note(const std::string& file, Location location, const std::string& what,
                  const std::string& todo) {
  const Problem problem{file, location, what, todo};
  return {message(problem, "note"), {}, true, problem};
}

}  // namespace frontend
