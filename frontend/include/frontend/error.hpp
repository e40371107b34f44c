// The one exception type for what a user can cause, with its place in a file; and warnings.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace frontend {

/// A place in a file. Lines and columns count from 1, columns in bytes. Line 0 means no place.
struct Location {
  uint32_t line = 0;
  uint32_t column = 0;
};

/// What a message says. Texts may be empty.
struct Problem {
  std::string file;  // as messages show it
  Location location;
  std::string what, todo;
  // What messages do not show:
  std::string path{};   // absolute, of the file; empty where `file` alone tells it
  uint32_t column = 0;  // in characters
};

/// A warning is collected and shown on stderr, not thrown.
struct Warning {
  std::string text;        // like an Error's what(), with "warning" in place of "error"
  std::string error_text;  // what() of the Error that it becomes where warnings are errors
  /// OpenSCAD says nothing of it: it never becomes an error.
  bool is_note = false;
  Problem problem{};
};

/// what() is "file:line:column: error: what (what to do)", without those places that are not known.
class Error : public std::runtime_error {
 public:
  Error(const std::string& file, Location location, const std::string& what,
        const std::string& todo);
  explicit Error(const Warning& warning);
  explicit Error(Problem problem);

  const Problem& problem() const { return *problem_; }

 private:
  std::shared_ptr<const Problem> problem_;  // shared, since copies of an exception must not throw
};

/// Any of `file`, `location` and `todo` may be empty, and is then left out of the text.
Warning make_warning(const std::string& file, Location location, const std::string& what,
                     const std::string& todo);
/// Returns a warning that is a note, with that word in its text.
Warning make_note(const std::string& file, Location location, const std::string& what,
                  const std::string& todo);

}  // namespace frontend
