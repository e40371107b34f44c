// The texts by which parameter sets give values (LANGUAGE.md, "Text").
#pragma once

#include <memory_resource>
#include <string_view>

#include "language/value.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Returns the literal that a text stands for where the parameter's default has a type, in an
/// arena, at a place. Null: the text is of another type, or the type is none that sets can give.
const Expression* parameter_literal(std::pmr::memory_resource& arena, Place place,
                                    std::string_view text, ValueType type);

}  // namespace language
