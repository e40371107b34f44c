// Expressions as OpenSCAD's messages and str() spell them.
#pragma once

#include <string>

#include "base/name_table.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// Appends an expression in OpenSCAD's normal form (LANGUAGE.md, "Grammar"). Does not recurse.
void append_expression_text(std::string& out, const Expression& expression, const NameTable& names);

}  // namespace language
