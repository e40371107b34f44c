// Runs compiled code (LANGUAGE.md, "Scopes and calls").
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "code/compiler.hpp"
#include "evaluation/closure.hpp"
#include "evaluation/dependency_log.hpp"
#include "evaluation/dynamic_names.hpp"
#include "evaluation/frame.hpp"
#include "evaluation/kept_calls.hpp"
#include "evaluation/record.hpp"
#include "evaluation/unit_cache.hpp"
#include "evaluation/value_stack.hpp"
#include "functions/builtin_functions.hpp"
#include "language/make.hpp"
#include "language/node_tree.hpp"
#include "messages/messages.hpp"
#include "modules/builtin_modules.hpp"
#include "values/operators.hpp"

namespace language {

// OpenSCAD ends at the size of its stack, after some 8,600 calls (LANGUAGE.md, "Differences").
constexpr size_t kDepthLimit = 250000;

/// Thrown where the evaluation of a design ends early; its error has been said.
class Aborted : public std::exception {
 public:
  const char* what() const noexcept override { return "aborted"; }
};

/// Thrown by the sink of messages at a warning, if warnings end the evaluation.
class HardWarning : public std::exception {
 public:
  const char* what() const noexcept override { return "warning"; }
};

class Machine {
 public:
  /// Adds its nodes to `tree`.
  Machine(Compiler& compiler, Messages& messages, ModuleEnvironment& modules, NodeTree& tree,
          std::stop_token stop);
  ~Machine();

  /// Gives a `$` name its value before the program begins.
  void preset(std::string_view name, Value value);
  /// Evaluates an expression where no variable is known, and returns the type of its value. Throws
  /// like run_assignments().
  ValueType type_of(const Expression& expression);
  /// Evaluates the assignments of the main file's top level. Throws Aborted, after the error and
  /// its traces, or Stopped.
  void run_assignments();
  /// Returns the value that the top level has assigned to a `$` name: unset if it has not.
  Value top_level_value(std::string_view name) const;
  /// Evaluates the module calls of the main file. Throws like run_assignments().
  void run_calls();
  /// Forgets the `$` names of calls that Aborted has ended.
  void end_early();
  /// Lets the machine use top levels that earlier evaluations have kept. They must not change.
  void use_kept(const KeptTops& tops) { kept_tops_ = &tops; }
  /// Keeps the top levels that this evaluation has seen for later ones.
  void save_units(KeptTops& tops);
  /// Lets the machine use calls of modules of an earlier evaluation, which must not change, and
  /// keep its own.
  void use_calls(const KeptCalls& earlier);
  /// Returns the calls that it has kept, without tree and files.
  KeptCalls take_calls() { return std::move(calls_); }

 private:
  // run.cpp
  void run();  // until the first frame has ended

  // machine.cpp
  bool execute(const Instruction& step);  // true: the first frame has ended
  void run_guarded();

  // variables.cpp
  HeapScope* scope_at(uint32_t number) const;
  /// Returns a reference to the scope around what a site calls; that of a used file waits for it.
  HeapScope* take_scope(const CallSite& site);
  void push_dynamic(Name name, bool silently);
  void unknown_variable(Name name);
  void push_scope(uint32_t size);
  void pop_scope();
  void store_scoped(const Instruction& step);

  // operators.cpp
  using Operator = Value (*)(const Value&, const Value&, OperatorProblem&);
  void binary(Operator op);
  void unary(Value (*op)(const Value&, OperatorProblem&));
  void say_problem(const OperatorProblem& problem);
  void make_range(uint16_t flags);
  void make_vector(uint32_t count);
  void make_closure(uint32_t index);
  void echo(const EchoSite& site);
  void assert_top(const AssertSite& site, bool has_message);
  void duplicate_let(Name name);
  void unnamed_let();

  // loops.cpp
  void begin_loop(uint16_t kind);
  bool next_round(uint32_t state);  // false: there is none
  void append_each(uint32_t slot);
  void append_each_of_all(uint32_t slot);
  void append_expanded(Value& vector, const Value& value);
  void count_round(uint32_t slot);
  void too_many(uint32_t count);

  // calls.cpp
  void push_frame(const Code& code, uint32_t base, HeapScope* scope, FrameKind kind,
                  uint32_t activation);
  void pop_frame();
  void begin_call(const CallSite& site);
  /// Pushes the declared parameters with their constant defaults. Returns the first one's slot.
  uint32_t push_parameters(const Callable& callable);
  void call_function(const CallSite& site);
  void call_builtin(uint32_t index, uint32_t count);
  void next_lazy(const LazyCall& site);
  void keep_lazy(const LazyCall& site);
  void return_value();
  void return_defaults();
  void tail_jump(uint32_t slots, uint32_t target);
  void say_argument_warnings(uint32_t plan, bool once);
  void warn_count(Name name);
  void unknown_function(Name name);
  bool nests_too_deeply() const;
  [[noreturn]] void recursion_in_function(std::string_view name, Place place);

  // dynamic_calls.cpp
  void prepare_call(const DynamicCall& site);
  void next_argument(const DynamicCall& site);
  void call_dynamic(const DynamicCall& site);
  void call_dynamic_function(const DynamicCall& site, FunctionEntry& function);
  FunctionEntry* function_of(const DynamicCall& site);
  HeapScope* scope_of(const DynamicCall& site);
  bool refuse_callee(const DynamicCall& site);
  void give_up_call(const DynamicCall& site);
  void keep_defaults(uint32_t base);
  [[noreturn]] void recursion_in_callee(const DynamicCall& site);
  std::string callee_text(const Expression& callee) const;
  const ArgumentPlan& plan_of(const DynamicCall& site, FunctionEntry& function);

  // units.cpp
  void enter_unit(uint32_t unit);
  bool end_unit();  // true: of the main file
  bool reuse_unit(uint32_t unit);
  void keep_unit(const Record& record, HeapScope* scope);

  // records.cpp
  Record& begin_record(uint32_t unit);
  void end_record();
  void note_read(Name name);
  void note_code(const Code& code);
  void note_history();
  void note_builtin(const BuiltinFunction& function, std::span<const Value> arguments);
  void note_parent(std::span<const Value> arguments);
  bool has_said_nothing(const Record& record) const;
  NamedValues noted_reads(const Record& record) const;
  uint32_t variable_number(uint32_t slot) const { return definitions_ + slot; }
  uint32_t read_number(Name name) const { return definitions_ + variables_ + name; }

  // call_reuse.cpp
  bool is_kept(const CallSite& site, const HeapScope* scope) const;
  bool begin_kept_call(const CallSite& site);  // true: its nodes have been reused
  void end_kept_call();
  bool is_same_call(const KeptCall& call, const ModuleEntry& module,
                    std::span<const Value> arguments);
  bool reuse_call(size_t position);
  void note_kept(const KeptCall& call);
  void keep_call(const Record& record);
  bool keep_variable(uint32_t slot);

  // saved_units.cpp
  void load_unit(uint32_t unit);
  void save_unit(uint32_t unit, KeptTops& tops);

  // modules.cpp
  void begin_node(const NodeSite& site) { begin_node(site.kind, site.modifiers); }
  void begin_node(NodeKind kind, uint8_t modifiers);
  void end_node(bool drop_if_empty);
  void make_node(const NodeSite& site, uint32_t no_children, bool takes_children);
  bool wants_first(const NodeSite& site);
  Value dynamic_value(Name name);
  BuiltinCall builtin_call(const NodeSite& site, bool has_first);
  void name_module(Name name);
  void call_module(const CallSite& site);
  void return_module();
  void say_successor(const NodeSite& site);
  void refuse_children(const NodeSite& site);
  void unknown_module(Name name);
  void parameter_literal(Name parameter, Name module);

  // children.cpp
  void all_children(const NodeSite& site);
  void say_child_is_deprecated();
  bool select_children(const NodeSite& site, bool is_child);
  bool is_child_number(int number, bool is_child);
  Value next_selected(uint32_t state);
  void next_child(uint32_t state, uint32_t after);
  void end_selection();
  bool end_child(bool is_last);  // true: of the frame that runs children
  const Activation* activation() const;
  uint32_t child_count() const;
  void run_block(FrameKind kind, uint32_t child);

  // tracing.cpp
  Place place() const { return frames_.back().code->places[next_ - 1]; }
  void warn(std::string text, PathBase base);
  [[noreturn]] void fail(std::string text, Place place);
  void say_traces();
  void set_unit(uint32_t unit);
  void check_limits();
  void count_step() {
    if (--steps_ == 0) check_limits();
  }
  uint64_t work() const { return counted_ - steps_; }

  Compiler& compiler_;
  Messages& messages_;
  ModuleEnvironment& modules_;
  NodeTree& tree_;
  FunctionEnvironment functions_;
  std::stop_token stop_;
  std::span<const BuiltinFunction> builtin_functions_;
  std::span<const BuiltinModule> builtin_modules_;

  HeapScopes scopes_;
  DynamicNames dynamic_;
  ValueStack stack_;
  std::vector<Frame> frames_;
  std::vector<Activation> activations_;
  std::vector<HeapScope*> unit_scopes_;   // of used files whose functions are about to be called
  std::vector<HeapScope*> block_scopes_;  // of blocks whose modules are about to be called
  std::vector<uint32_t> open_nodes_;      // of the tree, from outside in
  std::vector<std::string_view> module_names_;
  std::vector<Value> parameters_;  // of the call that is being made
  std::vector<Record> records_;    // of the parts that are being evaluated, from outside in
  DependencyLog dependencies_;     // of these: definitions, then variables, then `$` names
  uint32_t definitions_;           // of the main unit's top level
  uint32_t variables_;             // the same
  uint64_t record_ = 0;            // number of the innermost record since its last change; 0: none
  uint64_t records_made_ = 0;
  std::vector<KeptUnit> kept_units_;
  uint32_t preset_trail_ = 0;  // the trail's length before the program begins
  uint32_t main_trail_ = 0;    // and once the top level's assignments are evaluated

  // The frame on top of frames_, as far as it changes.
  const Instruction* code_ = nullptr;
  uint32_t next_ = 0;
  uint32_t base_ = 0;
  HeapScope* scope_ = nullptr;
  uint32_t unit_ = 0;  // whose code runs
  HeapScope* main_scope_ = nullptr;
  uint32_t steps_ = 1;
  uint64_t counted_ = 1;  // steps until the next look at the limits; what was reused counts, too
  const KeptTops* kept_tops_ = nullptr;  // null: none
  bool keeps_calls_ = false;
  std::optional<CallIndex> earlier_calls_;  // that can be used
  KeptCalls calls_;
  Name fragments_number_, fragments_angle_, fragments_size_, parent_modules_;
};

}  // namespace language
