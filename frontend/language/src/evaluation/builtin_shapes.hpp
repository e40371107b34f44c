// What the compiler has to know of the builtin functions and modules.
#pragma once

#include "base/name_table.hpp"
#include "code/compiler.hpp"

namespace language {

Builtins builtin_shapes(NameTable& names);

}  // namespace language
