#include "frontend/error.hpp"

namespace frontend {
namespace {

/// Writes "file:line:column: severity: what (todo)", without the parts that are empty or 0.
std::string message(const std::string& file, Location location, const char* severity,
                    const std::string& what, const std::string& todo) {
  std::string text = file;
  if (location.line > 0) {
    if (!text.empty()) text += ':';
    text += std::to_string(location.line);
    if (location.column > 0) text += ':' + std::to_string(location.column);
  }
  if (!text.empty()) text += ": ";
  text += severity;
  text += ": " + what;
  if (!todo.empty()) text += " (" + todo + ')';
  return text;
}

}  // namespace

Error::Error(const std::string& file, Location location, const std::string& what,
             const std::string& todo)
    : std::runtime_error(message(file, location, "error", what, todo)) {}

Warning make_warning(const std::string& file, Location location, const std::string& what,
                     const std::string& todo) {
  return {message(file, location, "warning", what, todo),
          message(file, location, "error", what, todo)};
}

Warning make_note(const std::string& file, Location location, const std::string& what,
                  const std::string& todo) {
  return {message(file, location, "note", what, todo), {}, true};
}

}  // namespace frontend
