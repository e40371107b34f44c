#include "evaluation/builtin_shapes.hpp"

#include "functions/builtin_functions.hpp"
#include "modules/builtin_modules.hpp"

namespace language {
namespace {

ModuleShape shape_of(const BuiltinModule& module, uint32_t index, NameTable& names) {
  ModuleShape shape{};
  shape.index = index;
  for (const auto& list : {module.positional, module.named_only})
    for (const std::string_view name : list) shape.parameters.push_back(names.intern(name));
  shape.positional = module.positional.size();
  shape.takes_children = module.children == ChildRule::kTakes;
  shape.refuses_children = module.children == ChildRule::kRefuses;
  shape.successor = module.successor;
  shape.wants_first = module.wants_first != nullptr;
  return shape;
}

}  // namespace

Builtins builtin_shapes(NameTable& names) {
  Builtins builtins;
  uint32_t index = 0;
  for (const BuiltinFunction& function : builtin_functions()) {
    builtins.functions[names.intern(function.name)] = {index++, function.least_arguments,
                                                       function.most_arguments,
                                                       function.next_argument != nullptr};
  }
  index = 0;
  for (const BuiltinModule& module : builtin_modules()) {
    builtins.modules[names.intern(module.name)] = shape_of(module, index, names);
    ++index;
  }
  return builtins;
}

}  // namespace language
