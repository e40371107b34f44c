// The calls that an evaluation is in, and what they hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "code/code.hpp"
#include "evaluation/dynamic_names.hpp"
#include "evaluation/heap_scope.hpp"
#include "evaluation/limits.hpp"
#include "evaluation/recorder.hpp"
#include "evaluation/value_stack.hpp"
#include "functions/builtin_functions.hpp"
#include "messages/messages.hpp"
#include "syntax/program.hpp"

namespace language {

enum class FrameKind : uint8_t {
  kFunction,
  kDefaults,         // the defaults of a call, which are left in its slots
  kDynamicDefaults,  // … or packed into a vector, in the slot below
  kModule,
  kBlock,      // all children of a block
  kChild,      // one of them
  kSelection,  // some of them, which its first slots tell
  kUnit,       // the assignments of a used file's top level
  kMainUnit,   // … of the main file's
};

constexpr uint32_t kNoActivation = 0xFFFFFFFFu;

// OpenSCAD ends at the size of its stack, after some 8,600 calls (LANGUAGE.md, "Differences").
constexpr size_t kDepthLimit = 250000;

/// What is known of a call.
struct Frame {
  const Code* code;
  uint32_t next;        // the instruction that comes next
  uint32_t base;        // of its slots in the stack
  HeapScope* scope;     // the innermost one; counted
  uint32_t trail;       // its length when the frame was made
  uint32_t activation;  // of the user module that the code stands in, or kNoActivation
  int64_t memory;       // that values took when the frame was made, in bytes
  FrameKind kind;
  uint32_t rounds = 0;               // of tail calls
  const Callable* callee = nullptr;  // of a function, or a user module
  Name called_as = kNoName;          // of a function value: the name in its call
  Place call{};                      // of a function value, or a user module
  const Code* tail_code = nullptr;   // whose call in tail position has begun it anew; null: none
  uint32_t tail_next = 0;            // the instruction behind that call
};

/// Owns what calls hold, innermost on top: frames, values, scopes, `$` names, and the records of
/// what they depend on. Knows where the innermost one has come to; messages are said there.
class CallStack {
 public:
  CallStack(const Program& program, FunctionEnvironment& environment, const NodeTree& tree,
            std::stop_token stop);

  StepCount steps;
  HeapScopes scopes;  // outlive the values, some of which refer to them
  DynamicNames dynamic;
  Recorder recorder;
  ValueStack values;

  /// Begins a call whose slots begin at `base`, or on top of all values. Takes over a reference to
  /// `scope`.
  void push(const Code& code, uint32_t base, HeapScope* scope, FrameKind kind,
            uint32_t activation = kNoActivation);
  void push(const Code& code, HeapScope* scope, FrameKind kind) {
    push(code, values.size(), scope, kind);
  }
  /// Lets code take the place of the innermost call's, with the values on top as its first slots.
  /// Takes over a reference to `scope`.
  void replace(const Code& code, uint32_t slots, HeapScope* scope);
  /// Ends the innermost call. Its values and `$` names stay.
  void pop();
  /// Ends the innermost call with its values and `$` names.
  void leave() {
    values.drop_to(base_);
    dynamic.undo(frames_.back().trail);
    pop();
  }
  bool is_empty() const { return frames_.empty(); }
  size_t depth() const { return frames_.size(); }
  /// Returns whether the calls nest too deeply for another one.
  bool nests_too_deeply() const { return depth() > kFewCalls && takes_too_much(); }
  /// Counts a tail call of the innermost call. Returns whether there have been too many.
  bool loops_too_long();

  // Of the innermost call; only what jump() and scopes change differs from its frame:
  Frame& frame() { return frames_.back(); }
  const Frame& frame() const { return frames_.back(); }
  const Code& code() const { return *frames_.back().code; }
  const Instruction* instructions() const { return instructions_; }
  /// The instruction that comes next.
  uint32_t next() const { return next_; }
  void jump(uint32_t target) { next_ = target; }
  uint32_t base() const { return base_; }
  Value& slot(uint32_t number) { return values[base_ + number]; }

  HeapScope* scope() const { return scope_; }
  HeapScope* scope_at(uint32_t number) const;
  void push_scope(uint32_t size) { scope_ = scopes.make(scope_, size); }
  void pop_scope();
  /// Goes on with a copy of the innermost scope, if something else refers to it.
  void renew_scope();

  /// Keeps the scope of a used file for the call of one of its functions or modules. Takes over a
  /// reference.
  void keep_unit_scope(HeapScope* scope) { unit_scopes_.push_back(scope); }
  /// Returns the scope around what is called: the one that was kept last, or of a number. The
  /// second takes it with a reference.
  HeapScope* scope_around(bool is_in_unit, uint32_t number) const {
    return is_in_unit ? unit_scopes_.back() : scope_at(number);
  }
  HeapScope* take_scope_around(bool is_in_unit, uint32_t number) {
    HeapScope* const scope = scope_around(is_in_unit, number);
    if (!is_in_unit) return HeapScopes::acquire(scope);
    unit_scopes_.pop_back();
    return scope;
  }

  // Messages
  Messages& messages() { return environment_.messages; }
  Place place() const { return frames_.back().code->places[next_ - 1]; }
  std::string text_of(Name name) const { return std::string(program_.names.text(name)); }
  /// Returns the text of a callee that is no name.
  std::string text_of(const Expression& callee) const;
  void warn(std::string text, PathBase base) {
    environment_.messages.warn(std::move(text), place(), base);
  }
  /// Says an error and its traces. Throws Aborted.
  [[noreturn]] void fail(std::string text, Place place);
  /// The same where the calls nest too deeply, of a "function" or a "module".
  [[noreturn]] void fail_recursion(const char* kind, std::string_view name, Place place);
  /// Says the calls that enclose the place, from inside out.
  void say_traces();
  void say_trace(std::string text, Place place);
  /// Sets how many lines they take at most, and whether modules tell their parameters.
  void set_traces(uint32_t most_lines, bool has_parameters) {
    most_traces_ = most_lines;
    traces_parameters_ = has_parameters;
  }

 private:
  // A recursion that goes on for longer than these calls, and makes more than some bytes of values
  // that last, is endless: it would only end when it has taken all memory. OpenSCAD allows some
  // 8,600 nested calls, so that each of them would have to keep some thousand numbers.
  static constexpr size_t kFewCalls = 3000;

  bool takes_too_much() const;
  void enter(const Code& code, uint32_t next, uint32_t base, HeapScope* scope);
  std::string call_text(const Frame& frame);
  const TraceRegion* tail_call(const Frame& frame) const;
  void set_unit(uint32_t unit);

  const Program& program_;
  FunctionEnvironment& environment_;
  std::vector<Frame> frames_;
  std::vector<HeapScope*> unit_scopes_;
  uint32_t unit_ = 0;  // whose code runs
  uint32_t most_traces_ = 12;
  bool traces_parameters_ = true;

  // The innermost frame, as far as it changes.
  const Instruction* instructions_ = nullptr;
  uint32_t next_ = 0;
  uint32_t base_ = 0;
  HeapScope* scope_ = nullptr;
};

}  // namespace language
