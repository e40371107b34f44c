#include "code/compiler.hpp"

#include <type_traits>

#include "code/expression_facts.hpp"

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
      index(names.intern("index")),
      group(names.intern("group")),
      union_(names.intern("union")),
      difference(names.intern("difference")),
      intersection(names.intern("intersection")),
      this_(names.intern("this")) {}

Compiler::Compiler(Program& program, DefinitionReader& definitions, Builtins builtins,
                   const CompilerOptions& options)
    : program_(program),
      definitions_(definitions),
      builtins_(std::move(builtins)),
      options_(options),
      known_(program.names),
      units_(program.units.size()) {}

void Compiler::prepare(Callable& callable) {
  if (callable.is_prepared) return;
  callable.is_prepared = true;
  callable.parameters = ParameterList(callable.written_parameters, names(), dialect());
  const bool has_defaults_of_callee = dialect().has_arguments_first;
  for (const Expression* value : callable.parameters.defaults) {
    auto constant = value ? constant_value(*value) : Value::undef();
    if (!constant.is_set() && !has_defaults_of_callee) {
      callable.has_default_code = true;
      constant = Value::undef();
    }
    callable.initial.push_back(std::move(constant));
  }
  for (const Target& target : callable.parameters.targets)
    if (target.is_dynamic) callable.has_default_code = true;
}

ArgumentPlan Compiler::plan(Callable& callable, std::span<const Argument> arguments, Place call,
                            Name taken) {
  prepare(callable);
  const size_t slots = callable.parameters.slot_names.size();
  ArgumentPlan plan =
      plan_arguments(arguments, callable.parameters, callable.parameters.targets.size(), call,
                     names(), dialect(), taken);
  if (callable.parameters.slot_names.size() != slots) callable.code = nullptr;
  return plan;
}

ArgumentPlan Compiler::plan_module(ModuleEntry& module, std::span<const Argument> arguments,
                                   Place call) {
  ArgumentPlan result = plan(module, arguments, call);
  if (!options_.check_parameters) {
    std::erase_if(result.warnings,
                  [](const ArgumentWarning& warning) { return warning.is_resolution; });
  }
  return result;
}

ArgumentPlan Compiler::plan_builtin(std::span<const Name> parameters, size_t positional,
                                    std::span<const Argument> arguments, Place call) {
  ParameterList list(parameters, names());
  return plan_arguments(arguments, list, positional, call, names(), dialect());
}

template <typename Definition, typename Entry>
Found<Entry> Compiler::find(const ScopeLayout& from, Name name,
                            DefinedNames<Definition, Entry> ScopeLayout::*names_of) {
  const auto find_in = [&](const ScopeLayout& scope) -> Entry* {
    const auto& names = scope.*names_of;
    const auto found = names.find(name);
    if (found == names.end()) return nullptr;
    const auto& [written, entry] = found->second;
    return entry ? entry : entry = &add_entry(*written, scope);
  };
  for (const ScopeLayout* scope = &from; scope; scope = scope->parent)
    if (Entry* const entry = find_in(*scope)) return {entry, false};
  const auto& uses = program_.units[from.unit].uses;
  for (auto used = uses.rbegin(); used != uses.rend(); ++used)
    if (Entry* const entry = find_in(*unit(*used).scope)) return {entry, true};
  return {};
}

Found<FunctionEntry> Compiler::find_function(const ScopeLayout& from, Name name) {
  return find(from, name, &ScopeLayout::functions);
}

Found<ModuleEntry> Compiler::find_module(const ScopeLayout& from, Name name) {
  return find(from, name, &ScopeLayout::modules);
}

FunctionEntry& Compiler::add_entry(const FunctionDefinition& written, const ScopeLayout& scope) {
  const FunctionDefinition::Content& content = definitions_.content_of(written);
  return functions_.emplace_back(FunctionEntry{
      {written.name, written.place, content.parameters, &scope}, content.body, nullptr});
}

ModuleEntry& Compiler::add_entry(const ModuleDefinition& written, const ScopeLayout& scope) {
  const ModuleDefinition::Content& content = definitions_.content_of(written);
  return modules_.emplace_back(
      ModuleEntry{{written.name, written.place, content.parameters, &scope}, content.body});
}

FunctionEntry& Compiler::add_literal(const FunctionExpression& literal, const ScopeLayout& scope) {
  return functions_.emplace_back(
      FunctionEntry{{kNoName, literal.place, literal.parameters, &scope}, literal.body, &literal});
}

FunctionEntry& Compiler::add_expression(const Expression& body) {
  const ScopeLayout& nothing = add_scope(nullptr, 0, nullptr, true);
  return functions_.emplace_back(
      FunctionEntry{{kNoName, body.place, {}, &nothing}, &body, nullptr});
}

BlockEntry& Compiler::add_block(std::span<const ModuleCall> calls, const ScopeLayout& scope,
                                const Scope* assigned) {
  return blocks_.emplace_back(
      BlockEntry{calls, &scope, assigned, dialect().has_plain_children ? kSelectionSlots : 0});
}

ScopeLayout& Compiler::add_scope(const ScopeLayout* parent, uint32_t unit, const Code* code,
                                 bool is_in_heap) {
  return scopes_.emplace_back(parent, unit, code, is_in_heap);
}

void Compiler::define(ScopeLayout& layout, const Scope& scope) {
  layout.functions.reserve(scope.functions.size());
  for (const FunctionDefinition& function : scope.functions)
    layout.functions[function.name] = {&function};
  layout.modules.reserve(scope.modules.size());
  for (const ModuleDefinition& module : scope.modules) layout.modules[module.name] = {&module};
}

Code& Compiler::add_code(uint32_t unit) {
  Code& code = codes_.emplace_back();
  code.unit = unit;
  return code;
}

}  // namespace language
