// Compiled code, and the definitions that it belongs to (LANGUAGE.md, "Scopes and calls").
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "code/instruction.hpp"
#include "code/parameter_list.hpp"
#include "code/scope_layout.hpp"
#include "language/node_kind.hpp"
#include "language/value.hpp"
#include "syntax/syntax.hpp"

namespace language {

struct Code;

/// A function, by definition or by literal, or a module. Its code is compiled at the first call,
/// and anew where a call passes a name that it does not declare: then that is one of its variables.
struct Callable {
  Name name;  // kNoName: a literal
  Place place;
  std::span<const Parameter> written_parameters;
  const ScopeLayout* scope;  // where it is defined
  /// The following are filled in when a call is compiled or happens: Compiler::prepare().
  bool is_prepared = false;
  ParameterList parameters{};
  /// Per declared slot: the default if it is a literal; else undef, or unset where the callee
  /// itself evaluates what is not given.
  std::vector<Value> initial{};
  bool has_default_code = false;   // whether other defaults have to be evaluated
  const Code* defaults = nullptr;  // null: not compiled yet
  const Code* code = nullptr;      // null: not compiled, or no longer valid
};

struct FunctionEntry : Callable {
  const Expression* body;
  const FunctionExpression* literal;  // null: a definition
};

struct ModuleEntry : Callable {
  const Scope* body;
};

/// The slots that code of a block begins with where children() is a plain module: the selection of
/// children, and how many of them are done.
constexpr uint32_t kSelectionSlots = 2;

/// The children of a user module's call.
struct BlockEntry {
  std::span<const ModuleCall> calls;
  const ScopeLayout* scope;  // in which they are evaluated
  /// What is evaluated before them, each time; null: nothing.
  const Scope* assigned = nullptr;
  uint32_t slots = 0;          // kSelectionSlots, or none where each child is run by itself
  const Code* code = nullptr;  // null: not compiled yet
};

/// The number of is_undef(), which is none of builtin_functions().
constexpr uint32_t kIsUndefFunction = 0xFFFFFFFFu;

/// A call of a user function or module by its name.
struct CallSite {
  FunctionEntry* function = nullptr;  // one of both
  ModuleEntry* module = nullptr;
  uint32_t scope = 0;       // number of the scope where it is defined, unless it is in another unit
  bool is_in_unit = false;  // kEnterUnit has brought its scope
  uint32_t slots = 0;       // how many parameters the call has pushed
  BlockEntry* block = nullptr;  // of a module; null: no children
  uint8_t modifiers = 0;
};

/// A call whose callee is known when it happens. It takes a run of slots: the callee, the number of
/// steps done, the trail's mark, the arguments in their order, the evaluated defaults.
struct DynamicCall {
  const Expression* callee;
  Name name;  // kNoName: the callee is no variable
  std::span<const Argument> arguments;
  uint32_t slot = 0;                  // of the callee
  FunctionEntry* function = nullptr;  // what the name means if its variable holds no function …
  uint32_t function_scope = 0;
  bool is_in_unit = false;
  uint32_t unit = 0;
  std::optional<uint32_t> builtin;      // … or a builtin function
  bool is_tail = false;                 // it takes the place of the running function
  bool is_method = false;               // the callee is a part of the value in the slot before it
  std::vector<uint32_t> argument_code;  // where the code of each argument begins
  uint32_t next = 0;                    // where kNextArgument stands
  uint32_t end = 0;                     // behind the call
  /// By whether the callee gets an object as its parameter `this`.
  mutable std::array<std::unordered_map<FunctionEntry*, ArgumentPlan>, 2> plans{};
};

/// A call of a builtin function that decides which of its arguments are evaluated. Its slots are:
/// how many values there are, and room for them.
struct LazyCall {
  uint32_t builtin;
  uint32_t written;  // arguments
  uint32_t slot;
  uint32_t room;
  std::vector<uint32_t> argument_code{};
  std::vector<std::string_view> argument_names{};  // empty: it has none
};

struct NodeSite {
  NodeKind kind = NodeKind::kGroup;  // where no builtin module makes the node
  uint32_t module = 0;               // of builtin_modules()
  uint8_t modifiers = 0;
  bool is_list = false;        // its nodes belong to the node around it, and it is none
  uint32_t parameters = 0;     // how many values kMakeNode pops
  std::string_view call_name;  // of the module, for messages
  std::string_view successor;  // what to use instead of a deprecated module
};

struct EchoSite {
  std::vector<Name> names;  // of each value; kNoName: none
};

struct AssertSite {
  const Expression* condition;  // null: none
};

/// Which code runs within a call, for traces; inner calls stand before outer ones.
struct TraceRegion {
  uint32_t begin, end;
  std::string_view name;  // empty: the callee's text
  const Expression* callee;
  Place place;
  bool is_assignment = false;  // to the name, and no call
  bool is_tail = false;        // a call that takes the place of the running function's
  Place overwritten{};         // of the first assignment to the name, if there are several
};

struct Code {
  uint32_t unit = 0;  // whose text it stems from
  std::vector<Instruction> instructions;
  std::vector<Place> places;  // of each instruction
  std::vector<Value> constants;
  std::vector<FunctionEntry*> functions;
  std::vector<CallSite> calls;
  std::vector<DynamicCall> dynamic_calls;
  std::vector<LazyCall> lazy_calls;
  std::vector<ArgumentPlan> plans;
  std::vector<NodeSite> node_sites;
  std::vector<EchoSite> echoes;
  std::vector<AssertSite> asserts;
  std::vector<TraceRegion> regions;
  std::vector<uint32_t> entries;      // of a block: where each child's code begins
  uint32_t statements = 0;            // of a module: where those behind its assignments begin
  uint32_t slots = 0;                 // that parameters and undeclared arguments take
  uint32_t deepest = 0;               // slots that the frame takes at most
  mutable std::vector<Value> caches;  // defaults of tail calls; unset: not evaluated yet
  mutable std::vector<bool> said;     // which of the plans' warnings were said
};

}  // namespace language
