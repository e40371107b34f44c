// Escapes within strings (LANGUAGE.md, "Text").
#pragma once

#include <cstddef>
#include <string>

namespace language {

/// Appends what the escape at the start of a text stands for, and returns the escape's length. A
/// backslash that begins none stands for nothing. The text begins with a backslash and ends with
/// a NUL.
size_t append_escape(const char* text, std::string& value);

}  // namespace language
