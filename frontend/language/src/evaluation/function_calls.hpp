// Function calls.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "code/compiler.hpp"
#include "evaluation/call_stack.hpp"
#include "functions/builtin_functions.hpp"

namespace language {

/// Calls by name: of user functions, whose parameters take the slots of their frame, and of builtin
/// functions.
class FunctionCalls {
 public:
  FunctionCalls(Compiler& compiler, FunctionEnvironment& environment, CallStack& stack)
      : compiler_(compiler), environment_(environment), stack_(stack) {}

  /// Pushes the declared parameters of a function or a module, and has their defaults evaluated.
  void begin(const CallSite& site);
  void return_defaults();
  /// Pushes the declared parameters with their constant defaults. Returns the first one's slot.
  uint32_t push_parameters(const Callable& callable);
  void call(const CallSite& site, bool is_tail);
  void return_value();
  void check_rounds();
  void tail_jump(uint32_t slots, uint32_t target);
  /// Calls a builtin function with the topmost values.
  void call_builtin(uint32_t index, uint32_t count, std::span<const std::string_view> names = {});
  void next_lazy(const LazyCall& site);
  void keep_lazy(const LazyCall& site);
  void say_argument_warnings(uint32_t plan, bool once);
  void warn_count(uint32_t builtin, size_t found);
  void unknown_function(Name name);

 private:
  Compiler& compiler_;
  FunctionEnvironment& environment_;
  CallStack& stack_;
  const std::span<const BuiltinFunction> builtins_ = builtin_functions();
};

/// Calls whose callee is known when they happen: a function value, or what a name means otherwise.
class DynamicCalls {
 public:
  DynamicCalls(Compiler& compiler, CallStack& stack, FunctionCalls& functions)
      : compiler_(compiler), stack_(stack), functions_(functions) {}

  /// Begins a call whose callee is on top, or says why it is none.
  void prepare(const DynamicCall& site);
  /// Has the next argument evaluated, if there is one.
  void next_argument(const DynamicCall& site);
  void call(const DynamicCall& site);

 private:
  bool refuse_callee(const DynamicCall& site);
  FunctionEntry* function_of(const DynamicCall& site);
  HeapScope* scope_of(const DynamicCall& site);
  const Value* object_of(const DynamicCall& site);
  const ArgumentPlan& plan_of(const DynamicCall& site, FunctionEntry& function);
  void call_function(const DynamicCall& site, FunctionEntry& function);
  void call_builtin(const DynamicCall& site);
  uint32_t assign_arguments(const DynamicCall& site, const FunctionShape& shape);

  Compiler& compiler_;
  CallStack& stack_;
  FunctionCalls& functions_;
  std::vector<Value> parameters_;        // of the call that is being made
  std::vector<std::string_view> names_;  // of its arguments
};

}  // namespace language
