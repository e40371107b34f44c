// Parameter sets: values that a JSON file gives to a design's variables (-p and -P), as texts
// (LANGUAGE.md, "Text").
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "language/parameter_value.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"
#include "syntax/arena.hpp"
#include "syntax/program.hpp"
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

/// Evaluates a default where no name is known, and returns the type of its value.
using DefaultType = std::function<ValueType(const Expression& value)>;

/// Returns the set of this name in a file; nothing if there is none, which is said where the file
/// is to blame.
std::optional<ParameterSet> read_parameter_set(const std::string& file, const std::string& set,
                                               Messages& messages);

/// Replaces what the main file's top level assigns to variables that the set mentions, if the set's
/// text is of the default's type.
void apply_parameter_set(Program& program, Messages& messages, const ParameterSet& set,
                         const DefaultType& type_of);

}  // namespace language
