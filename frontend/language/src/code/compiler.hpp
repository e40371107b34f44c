// Compiles a program, each function and module when it is first called.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/name_table.hpp"
#include "code/code.hpp"
#include "syntax/parse_program.hpp"
#include "syntax/program.hpp"

namespace language {

// What the compiler has to know of the builtin functions and modules.

struct FunctionShape {
  uint32_t index;  // in builtin_functions()
  uint16_t least_arguments, most_arguments;
  bool is_lazy;                    // it decides which arguments are evaluated
  std::vector<Name> parameters{};  // that arguments are assigned to; empty: names are ignored
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

struct CompilerOptions {
  bool check_parameters = true;
  bool lazy_union = false;  // loops, blocks and children() add their nodes to the node around them
};

class CodeCompiler;

/// The top level of a file.
struct UnitEntry {
  std::unique_ptr<ScopeLayout> scope;
  const Code* assignments = nullptr;
  BlockEntry calls{};          // compiled for the main file only
  bool binds_dynamic = false;  // whether the assignments set `$` names
};

/// A function that a name means.
template <typename Entry>
struct Found {
  Entry* entry = nullptr;         // null: none has that name
  bool is_in_other_unit = false;  // it belongs to a file that the code's own file uses
};

class Compiler {
 public:
  Compiler(Program& program, DefinitionReader& definitions, Builtins builtins,
           const CompilerOptions& options);

  UnitEntry& unit(uint32_t number);
  /// Each of the following compiles what it returns, unless that has happened.
  const Code& code_of(FunctionEntry& function);
  const Code& code_of(ModuleEntry& module);
  const Code& code_of(BlockEntry& block);
  const Code& defaults_of(Callable& callable, bool is_module);

  /// Fills in what calls have to know of a function's or module's parameters.
  void prepare(Callable& callable);
  /// Returns how the arguments of a call are assigned. Code of the callee that lacks a variable for
  /// one of them is discarded.
  /// Unnamed arguments do not fill the parameter `taken`; kNoName: they fill all.
  ArgumentPlan plan(Callable& callable, std::span<const Argument> arguments, Place call,
                    Name taken = kNoName);
  ArgumentPlan plan_module(ModuleEntry& module, std::span<const Argument> arguments, Place call);
  /// The same for a builtin module, or a function that is called like one. Unnamed arguments fill
  /// the first parameters.
  ArgumentPlan plan_builtin(std::span<const Name> parameters, size_t positional,
                            std::span<const Argument> arguments, Place call);

  Found<FunctionEntry> find_function(const ScopeLayout& from, Name name);
  Found<ModuleEntry> find_module(const ScopeLayout& from, Name name);

  FunctionEntry& add_literal(const FunctionExpression& literal, const ScopeLayout& scope);
  /// Returns a function whose body is an expression that no scope surrounds.
  FunctionEntry& add_expression(const Expression& body);
  BlockEntry& add_block(std::span<const ModuleCall> calls, const ScopeLayout& scope,
                        const Scope* assigned = nullptr);
  ScopeLayout& add_scope(const ScopeLayout* parent, uint32_t unit, const Code* code,
                         bool is_in_heap);
  /// Makes the functions and modules of a scope known.
  void define(ScopeLayout& layout, const Scope& scope);

  const Program& program() const { return program_; }
  const NameTable& names() const { return program_.names; }
  const Dialect& dialect() const { return program_.dialect; }
  const Builtins& builtins() const { return builtins_; }
  bool has_lazy_union() const { return options_.lazy_union && dialect().has_lazy_unions; }
  /// Returns whether the design reads $parent_modules.
  bool counts_modules() const { return names().find("$parent_modules") != kNoName; }

  // Names that the language gives a meaning.
  struct KnownNames {
    explicit KnownNames(NameTable& names);
    Name pi, is_undef, children, child, child_count, let, assign, for_, intersection_for, echo,
        assert_, index, group, union_, difference, intersection, this_;
  };
  const KnownNames& known() const { return known_; }

 private:
  template <typename Definition, typename Entry>
  Found<Entry> find(const ScopeLayout& from, Name name,
                    DefinedNames<Definition, Entry> ScopeLayout::*names_of);
  FunctionEntry& add_entry(const FunctionDefinition& written, const ScopeLayout& scope);
  ModuleEntry& add_entry(const ModuleDefinition& written, const ScopeLayout& scope);
  Code& add_code(uint32_t unit);
  /// `compile` compiles the body of a function or a module.
  template <typename Entry>
  const Code& code_of_callable(Entry& entry, void (CodeCompiler::*compile)(Entry&));

  Program& program_;
  DefinitionReader& definitions_;
  Builtins builtins_;
  CompilerOptions options_;
  KnownNames known_;
  std::vector<std::unique_ptr<UnitEntry>> units_;
  std::deque<FunctionEntry> functions_;
  std::deque<ModuleEntry> modules_;
  std::deque<BlockEntry> blocks_;
  std::deque<ScopeLayout> scopes_;
  std::deque<Code> codes_;
};

}  // namespace language
