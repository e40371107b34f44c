// What is compiled when it is needed for the first time.
#include "code/code_compiler.hpp"
#include "code/compiler.hpp"

namespace language {

UnitEntry& Compiler::unit(uint32_t number) {
  auto& entry = units_[number];
  if (entry) return *entry;
  entry = std::make_unique<UnitEntry>();
  Code& code = add_code(number);
  entry->scope = std::make_unique<ScopeLayout>(nullptr, number, &code, true);
  static const Scope kEmpty{};
  const Scope& scope = program_.units[number].scope ? *program_.units[number].scope : kEmpty;
  define(*entry->scope, scope);
  entry->binds_dynamic = CodeCompiler(*this, code, *entry->scope).compile_unit(scope);
  entry->assignments = &code;
  entry->calls = {scope.calls, entry->scope.get()};
  return *entry;
}

const Code& Compiler::code_of(FunctionEntry& function) {
  if (function.code) return *function.code;
  prepare(function);
  Code& code = add_code(function.scope->unit);
  size_t slots = 0;
  do {  // a call of itself may pass it a name that it does not declare
    slots = function.parameters.slot_names.size();
    code = Code();
    code.unit = function.scope->unit;
    CodeCompiler(*this, code, *function.scope).compile_function(function);
  } while (function.parameters.slot_names.size() != slots);
  function.code = &code;
  return code;
}

const Code& Compiler::code_of(ModuleEntry& module) {
  if (module.code) return *module.code;
  prepare(module);
  Code& code = add_code(module.scope->unit);
  size_t slots = 0;
  do {  // a call of itself may pass it a name that it does not declare
    slots = module.parameters.slot_names.size();
    code = Code();
    code.unit = module.scope->unit;
    CodeCompiler(*this, code, *module.scope).compile_module(module);
  } while (module.parameters.slot_names.size() != slots);
  module.code = &code;
  return code;
}

const Code& Compiler::code_of(BlockEntry& block) {
  if (block.code) return *block.code;
  Code& code = add_code(block.scope->unit);
  CodeCompiler(*this, code, *block.scope).compile_block(block);
  block.code = &code;
  return code;
}

const Code& Compiler::defaults_of(Callable& callable, bool is_module) {
  if (callable.defaults) return *callable.defaults;
  Code& code = add_code(callable.scope->unit);
  CodeCompiler(*this, code, *callable.scope).compile_defaults(callable, is_module);
  callable.defaults = &code;
  return code;
}

}  // namespace language
