// Numbers as the language writes them.
#pragma once

#include <optional>
#include <string_view>

namespace language {

/// Returns the double nearest to a decimal number: digits with an optional point and exponent,
/// no sign. Numbers that are too small give 0; nothing is returned for those that are too large.
std::optional<double> decimal_number(std::string_view text);

}  // namespace language
