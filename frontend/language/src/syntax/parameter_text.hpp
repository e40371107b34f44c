// The texts by which parameter sets give values (LANGUAGE.md, "Text").
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "language/value.hpp"
#include "syntax/arena.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Returns a text without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// Splits a text at a sign that stands outside of quotes. The parts are trimmed.
std::vector<std::string_view> split(std::string_view text, char sign);

/// Returns the number that a text is, perhaps with a sign; nothing if it is none.
std::optional<double> signed_number(std::string_view text);

/// Returns the literal that a text stands for where the parameter's default has a type, in an
/// arena, at a place. Null: the text is of another type, or the type is none that sets can give.
const Expression* parameter_literal(Arena& arena, Place place, std::string_view text,
                                    ValueType type);

}  // namespace language
