// Parameter sets: values that a JSON file gives to a design's variables (-p and -P).
#pragma once

#include <functional>
#include <string>

#include "language/value.hpp"
#include "messages/messages.hpp"
#include "syntax/program.hpp"

namespace language {

/// Evaluates a default where no name is known, and returns the type of its value.
using DefaultType = std::function<ValueType(const Expression& value)>;

/// Replaces what the main file's top level assigns to variables that the set of this name in a
/// file mentions, if the set's text is of the default's type. Says what is wrong with the file.
void apply_parameter_set(Program& program, Messages& messages, const std::string& file,
                         const std::string& set, const DefaultType& type_of);

}  // namespace language
