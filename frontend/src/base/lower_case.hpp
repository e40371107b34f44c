// Letters in lower case.
#pragma once

#include <string>

namespace frontend {

/// Returns the text with ASCII's capitals in lower case, whatever the locale is.
inline std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace frontend
