// Values that are given for the parameters of builtin modules and functions.
#pragma once

#include <string>
#include <string_view>

#include "language/value.hpp"

namespace language {

/// Returns whether a parameter is given and is not undef.
inline bool is_given(const Value& value) { return value.is_set() && !value.is_undef(); }

/// Returns the number, or `otherwise` if the value is none.
double number_or(const Value& value, double otherwise);
/// Returns the string, or `otherwise` if the value is none.
std::string_view text_or(const Value& value, std::string_view otherwise);

/// Returns a text with the value as echo() shows it: undef if it is not set.
std::string shown(const Value& value);
/// Returns what is said of a parameter of another type than the expected one.
std::string wrong_type(std::string_view callee, std::string_view parameter,
                       std::string_view expected, const Value& found);

}  // namespace language
