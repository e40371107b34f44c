// OpenSCAD's builtin modules, from their arguments to nodes (LANGUAGE.md, "Builtin modules").
#pragma once

#include <span>

#include "modules/builtin_call.hpp"

namespace language {

/// All whose arguments are resolved by the rules of user modules. Left to the evaluator: for,
/// intersection_for, let, assign, if, echo, assert, children, child, each, group, union,
/// difference, intersection. Sorted by name.
std::span<const BuiltinModule> builtin_modules();

}  // namespace language
