// OpenSCAD's builtin functions (LANGUAGE.md, "Builtin functions").
#pragma once

#include <span>
#include <string_view>

#include "functions/function_call.hpp"

namespace language {

/// All but those which the evaluator has to see through: is_undef, echo, assert, let. Sorted by
/// name.
std::span<const BuiltinFunction> builtin_functions();

/// Returns the function of that name, or null.
const BuiltinFunction* find_builtin_function(std::string_view name);

}  // namespace language
