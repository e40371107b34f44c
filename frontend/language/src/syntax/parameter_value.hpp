// From the literals that a design gives its parameters to values (customizer.hpp).
#pragma once

#include <optional>

#include "language/parameter_value.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Returns the value of a literal that a parameter set can give; nothing if it is none.
std::optional<ParameterValue> literal_value(const Expression& literal);

}  // namespace language
