// Expressions as OpenSCAD's messages and str() spell them.
#pragma once

#include <string>

#include "base/name_table.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Appends an expression in OpenSCAD's normal form (LANGUAGE.md, "Grammar"). Does not recurse.
void append_expression_text(std::string& out, const Expression& expression, const NameTable& names);

/// Appends parameters with their defaults, without parentheses: "a, b = 1".
void append_parameters_text(std::string& out, std::span<const Parameter> parameters,
                            const NameTable& names);

}  // namespace language
