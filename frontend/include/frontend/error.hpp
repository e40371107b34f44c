// What a user can cause is reported by one exception type, with its place in the file.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace frontend {

/// Lines and columns count from 1; columns in bytes. line 0: no place within the file.
struct Location {
  uint32_t line = 0;
  uint32_t column = 0;
};

/// Not thrown, collected and shown on stderr.
struct Warning {
  std::string text;        // as an Error's, with "warning" for "error"
  std::string error_text;  // what() of the Error that it is where warnings are errors
};

/// what() is "file:line:column: error: what (what to do)", without the places that are not known.
class Error : public std::runtime_error {
 public:
  Error(const std::string& file, Location location, const std::string& what,
        const std::string& todo);
  explicit Error(const Warning& warning) : std::runtime_error(warning.error_text) {}
};

/// Any of `file`, `location` and `todo` may be empty; the text is then without them.
Warning make_warning(const std::string& file, Location location, const std::string& what,
                     const std::string& todo);

}  // namespace frontend
