// Runs compiled code (LANGUAGE.md, "Scopes and calls").
#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>

#include "code/compiler.hpp"
#include "evaluation/call_stack.hpp"
#include "evaluation/function_calls.hpp"
#include "evaluation/modules.hpp"
#include "evaluation/top_levels.hpp"
#include "evaluation/value_operations.hpp"
#include "functions/builtin_functions.hpp"
#include "language/node_tree.hpp"
#include "modules/builtin_modules.hpp"

namespace language {

/// Fetches instructions and hands each to the part that does it. The parts share the call stack.
class Machine {
 public:
  /// Adds its nodes to `tree`.
  Machine(Compiler& compiler, Messages& messages, ModuleEnvironment& modules, NodeTree& tree,
          std::stop_token stop);

  /// Gives a `$` name its value before the program begins.
  void preset(std::string_view name, Value value);
  /// CallStack::set_traces().
  void set_traces(uint32_t most_lines, bool has_parameters) {
    stack_.set_traces(most_lines, has_parameters);
  }
  /// Lets textmetrics() and fontmetrics() ask for fonts, those of some files among them.
  void use_fonts(TextMeter* meter, std::vector<std::string> files) {
    environment_.text_meter = meter;
    environment_.fonts = std::move(files);
  }
  /// Evaluates an expression where no variable is known, and returns the type of its value. Throws
  /// like run_assignments().
  ValueType type_of(const Expression& expression);
  /// Evaluates the assignments of the main file's top level. Throws Aborted, after the error and
  /// its traces, or Stopped.
  void run_assignments();
  /// Returns the value that the main file's top level has assigned to a name: unset if it has not.
  Value top_level_value(std::string_view name) const;
  /// Evaluates the module calls of the main file. Throws like run_assignments().
  void run_calls();
  /// Forgets the `$` names of calls that Aborted has ended.
  void end_early();
  /// Removes the nodes that these calls have left open, with all in them.
  void remove_open_nodes() { modules_.remove_open_nodes(); }

 private:
  void run();                             // run.cpp; until the first call has ended
  bool execute(const Instruction& step);  // true: the first call has ended
  void run_guarded();

  Compiler& compiler_;
  FunctionEnvironment environment_;
  CallStack stack_;
  TopLevels tops_;
  ValueOperations values_;
  FunctionCalls functions_;
  DynamicCalls dynamic_calls_;
  ModuleCalls modules_;
  Children children_;
  uint32_t preset_trail_ = 0;  // the trail's length before the program begins
  uint32_t main_trail_ = 0;    // and once the top level's assignments are evaluated
};

}  // namespace language
