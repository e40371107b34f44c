// The comment behind a parameter, which says what values it may have (customizer.hpp).
#pragma once

#include <string_view>

#include "language/customizer_parameter.hpp"

namespace language {

/// Gives a parameter what its comment says of its type of value; what it does not is left.
void annotate(CustomizerParameter& parameter, std::string_view comment);

}  // namespace language
