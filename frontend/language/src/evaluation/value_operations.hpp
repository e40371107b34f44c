// What instructions do with the values on top of the stack: variables, operators, vectors, loops,
// and what let, assert and echo say.
#pragma once

#include <cstdint>
#include <string_view>

#include "code/compiler.hpp"
#include "evaluation/call_stack.hpp"
#include "values/operators.hpp"

namespace language {

/// Each does what an instruction's comment in code/instruction.hpp says.
class ValueOperations {
 public:
  ValueOperations(const Compiler& compiler, CallStack& stack)
      : compiler_(compiler), stack_(stack), values_(stack.values) {}

  void push_dynamic(Name name, bool silently);
  void unknown_variable(Name name);
  void store_scoped(const Instruction& step);

  void binary(Value (*op)(const Value&, const Value&, OperatorProblem&));
  void unary(Value (*op)(const Value&, OperatorProblem&));
  void make_range(uint16_t flags);
  void make_vector(uint32_t count);
  void make_closure(uint32_t index);
  void echo(const EchoSite& site);
  void assert_top(const AssertSite& site, bool has_message);
  void duplicate_let(Name name);
  void unnamed_let();

  void begin_loop(uint16_t kind);
  bool next_round(uint32_t slot);  // false: there is none
  void append_each(uint32_t slot);
  void append_each_of_all(uint32_t slot);
  void count_round(uint32_t slot);

 private:
  void say(const OperatorProblem& problem);
  void append_expanded(Value& vector, const Value& value);
  void too_many(uint32_t count);

  const Compiler& compiler_;
  CallStack& stack_;
  ValueStack& values_;  // of the call stack
};

}  // namespace language
