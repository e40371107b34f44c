// Parameter sets: values that a JSON file gives to a design's variables (-p and -P).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "language/parameter_value.hpp"
#include "language/value.hpp"
#include "messages/messages.hpp"
#include "syntax/program.hpp"

namespace language {

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
