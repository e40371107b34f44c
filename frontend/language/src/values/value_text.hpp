// Values as text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "language/value.hpp"
#include "values/object_memory.hpp"

namespace language {

/// How large a text may become that is shown, or is a string: vectors that hold one another many
/// times take little memory, but their text has no end.
constexpr size_t kMostTextBytes = size_t{32} << 20;

/// Appends a string as the language writes it: in quotes, with escapes.
void append_string_literal(std::string& out, std::string_view text);

/// Appends a value as the .csg shows it: strings in quotes, nothing escaped. Any text that fits the
/// memory of values may result.
void append_value_text(std::string& out, const Value& value);

/// Appends a value as echo() shows it, which is the same. Throws TooLarge.
void append_echo_text(std::string& out, const Value& value);
/// Appends a value as str() does: a string as it is, strings within vectors in quotes. Throws
/// TooLarge.
void append_str_text(std::string& out, const Value& value);

/// Appends a value as echo() does, but of a string what is escaped in the language is escaped.
/// Throws TooLarge.
void append_quoted_text(std::string& out, const Value& value);

/// Throws TooLarge.
std::string echo_text(const Value& value);

}  // namespace language
