#include "code/compiler.hpp"

#include "code/code_compiler.hpp"
#include "code/constants.hpp"

namespace language {

Compiler::KnownNames::KnownNames(NameTable& names)
    : pi(names.intern("PI")),
      is_undef(names.intern("is_undef")),
      children(names.intern("children")),
      child(names.intern("child")),
      child_count(names.intern("$children")),
      let(names.intern("let")),
      assign(names.intern("assign")),
      for_(names.intern("for")),
      intersection_for(names.intern("intersection_for")),
      echo(names.intern("echo")),
      assert_(names.intern("assert")),
      group(names.intern("group")),
      union_(names.intern("union")),
      difference(names.intern("difference")),
      intersection(names.intern("intersection")),
      dxf_dim(names.intern("dxf_dim")),
      dxf_cross(names.intern("dxf_cross")) {}

Compiler::Compiler(Program& program, Builtins builtins, bool check_parameters)
    : program_(program),
      builtins_(std::move(builtins)),
      check_parameters_(check_parameters),
      known_(program.names),
      units_(program.units.size()) {}

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

void Compiler::prepare(Callable& callable) {
  if (callable.is_prepared) return;
  callable.is_prepared = true;
  callable.parameters = ParameterList(callable.written_parameters, names());
  for (const Expression* value : callable.parameters.defaults) {
    auto constant = value ? constant_value(*value) : Value::undef();
    if (!constant.is_set()) callable.has_default_code = true;
    callable.initial.push_back(constant.is_set() ? std::move(constant) : Value::undef());
  }
  for (const Target& target : callable.parameters.targets)
    if (target.is_dynamic) callable.has_default_code = true;
}

ArgumentPlan Compiler::plan(Callable& callable, std::span<const Argument> arguments, Place call) {
  prepare(callable);
  const size_t slots = callable.parameters.slot_names.size();
  ArgumentPlan plan = plan_arguments(arguments, callable.parameters,
                                     callable.parameters.targets.size(), call, names());
  if (callable.parameters.slot_names.size() != slots) callable.code = nullptr;
  return plan;
}

ArgumentPlan Compiler::plan_module(ModuleEntry& module, std::span<const Argument> arguments,
                                   Place call) {
  ArgumentPlan result = plan(module, arguments, call);
  if (!check_parameters_) {
    std::erase_if(result.warnings,
                  [](const ArgumentWarning& warning) { return warning.is_resolution; });
  }
  return result;
}

ArgumentPlan Compiler::plan_builtin(const ModuleShape& module, std::span<const Argument> arguments,
                                    Place call) {
  ParameterList parameters(module.parameters, names());
  return plan_arguments(arguments, parameters, module.positional, call, names());
}

Found<FunctionEntry> Compiler::find_function(const ScopeLayout& from, Name name) {
  for (const ScopeLayout* scope = &from; scope; scope = scope->parent) {
    const auto found = scope->functions.find(name);
    if (found != scope->functions.end()) return {found->second, false};
  }
  const auto& uses = program_.units[from.unit].uses;
  for (auto used = uses.rbegin(); used != uses.rend(); ++used) {
    const auto& functions = unit(*used).scope->functions;
    const auto found = functions.find(name);
    if (found != functions.end()) return {found->second, true};
  }
  return {};
}

Found<ModuleEntry> Compiler::find_module(const ScopeLayout& from, Name name) {
  for (const ScopeLayout* scope = &from; scope; scope = scope->parent) {
    const auto found = scope->modules.find(name);
    if (found != scope->modules.end()) return {found->second, false};
  }
  const auto& uses = program_.units[from.unit].uses;
  for (auto used = uses.rbegin(); used != uses.rend(); ++used) {
    const auto& modules = unit(*used).scope->modules;
    const auto found = modules.find(name);
    if (found != modules.end()) return {found->second, true};
  }
  return {};
}

FunctionEntry& Compiler::add_literal(const FunctionExpression& literal, const ScopeLayout& scope) {
  return functions_.emplace_back(
      FunctionEntry{{kNoName, literal.place, literal.parameters, &scope}, literal.body, &literal});
}

BlockEntry& Compiler::add_block(std::span<const ModuleCall> calls, const ScopeLayout& scope) {
  return blocks_.emplace_back(BlockEntry{calls, &scope});
}

ScopeLayout& Compiler::add_scope(const ScopeLayout* parent, uint32_t unit, const Code* code,
                                 bool is_in_heap) {
  return scopes_.emplace_back(parent, unit, code, is_in_heap);
}

void Compiler::define(ScopeLayout& layout, const Scope& scope) {
  for (const FunctionDefinition& definition : scope.functions) {
    layout.functions[definition.name] = &functions_.emplace_back(
        FunctionEntry{{definition.name, definition.place, definition.parameters, &layout},
                      definition.body,
                      nullptr});
  }
  for (const ModuleDefinition& definition : scope.modules) {
    layout.modules[definition.name] = &modules_.emplace_back(ModuleEntry{
        {definition.name, definition.place, definition.parameters, &layout}, definition.body});
  }
}

Code& Compiler::add_code(uint32_t unit) {
  Code& code = codes_.emplace_back();
  code.unit = unit;
  return code;
}

}  // namespace language
