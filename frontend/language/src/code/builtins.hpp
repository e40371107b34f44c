// What the compiler has to know of the builtin functions and modules.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/name_table.hpp"

namespace language {

struct FunctionShape {
  uint32_t index;  // in builtin_functions()
  uint16_t least_arguments, most_arguments;
  bool is_lazy;  // it decides which arguments are evaluated
};

struct ModuleShape {
  uint32_t index;  // in builtin_modules()
  std::vector<Name> parameters;
  size_t positional;           // how many of them unnamed arguments fill
  bool takes_children;         // false: they are not evaluated
  bool refuses_children;       // and that is said
  std::string_view successor;  // of a deprecated module, else empty
  bool wants_first;            // may ask for its first argument once more
};

struct Builtins {
  std::unordered_map<Name, FunctionShape> functions;
  std::unordered_map<Name, ModuleShape> modules;
};

}  // namespace language
