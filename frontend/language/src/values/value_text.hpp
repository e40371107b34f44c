// Values as text.
#pragma once

#include <string>

#include "language/value.hpp"

namespace language {

/// Appends a value as echo() shows it: strings in quotes, nothing escaped.
void append_echo_text(std::string& out, const Value& value);
/// Appends a value as str() does: a string as it is, strings within vectors in quotes.
void append_str_text(std::string& out, const Value& value);

std::string echo_text(const Value& value);

}  // namespace language
