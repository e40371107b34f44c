// What a design lets its user choose: the variables of its main file that a parameter set can give
// values to, and what the comments around them say (LANGUAGE.md, "Parameters").
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "language/customizer_parameter.hpp"

namespace language {

/// Returns the parameters in the text of a main file, in its order. Nothing if it cannot be parsed.
/// Files that it includes are not looked at.
std::optional<std::vector<CustomizerParameter>> customizer_parameters(std::string_view text);

}  // namespace language
