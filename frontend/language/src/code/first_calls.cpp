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

template <typename Entry>
const Code& Compiler::code_of_callable(Entry& entry, void (CodeCompiler::*compile)(Entry&)) {
  if (entry.code) return *entry.code;
  prepare(entry);
  Code& code = add_code(entry.scope->unit);
  size_t slots = 0;
  do {  // a call of itself may pass it a name that it does not declare
    slots = entry.parameters.slot_names.size();
    code = Code();
    code.unit = entry.scope->unit;
    (CodeCompiler(*this, code, *entry.scope).*compile)(entry);
  } while (entry.parameters.slot_names.size() != slots);
  entry.code = &code;
  return code;
}

const Code& Compiler::code_of(FunctionEntry& function) {
  return code_of_callable(function, &CodeCompiler::compile_function);
}

const Code& Compiler::code_of(ModuleEntry& module) {
  return code_of_callable(module, &CodeCompiler::compile_module);
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
