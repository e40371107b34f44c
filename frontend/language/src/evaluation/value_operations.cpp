// Operators, and what let, assert and echo say.
#include <memory>

#include "evaluation/machine.hpp"
#include "evaluation/operation_limit.hpp"
#include "language/make.hpp"
#include "syntax/syntax.hpp"
#include "values/object_memory.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {

void Machine::say_problem(const OperatorProblem& problem) {
  if (!problem.unplaced.empty()) messages_.say(MessageGroup::kWarning, problem.unplaced);
  if (!problem.text.empty()) warn(problem.text, PathBase::kUnit);
}

void Machine::binary(Operator op) {
  const OperationLimit limit;
  const Value left = stack_.pop();
  OperatorProblem problem;
  stack_.top() = op(left, stack_.top(), problem);
  if (!problem.text.empty()) say_problem(problem);
}

void Machine::unary(Value (*op)(const Value&, OperatorProblem&)) {
  const OperationLimit limit;
  OperatorProblem problem;
  stack_.top() = op(stack_.top(), problem);
  if (!problem.text.empty()) say_problem(problem);
}

void Machine::make_range(uint16_t flags) {
  if (!(flags & kHasStep)) {
    const Value end = stack_.pop();
    RangeProblem problem;
    stack_.top() = range_of(stack_.top(), end, problem);
    if (problem.is_reversed) {
      messages_.say(MessageGroup::kDeprecated,
                    "Using ranges of the form [begin:end] with begin value greater than the end "
                    "value is deprecated",
                    place(), PathBase::kUnit);
    }
    return;
  }
  const Value step = stack_.pop(), end = stack_.pop();
  const Value begin = stack_.pop();
  stack_.push(range_of(begin, step, end));
  if (!(flags & kChecksDirection) || !stack_.top().is_range()) return;
  if (step.number() > 0 && end.number() < begin.number())
    warn("begin is greater than the end, but step is positive", PathBase::kUnit);
  if (step.number() < 0 && end.number() > begin.number())
    warn("begin is smaller than the end, but step is negative", PathBase::kUnit);
}

void Machine::make_vector(uint32_t count) {
  Value vector = language::make_vector(count);
  auto& object = static_cast<VectorObject&>(*vector.object());
  stack_.pop_to(object.elements(), count);
  object.take_appended(count);
  stack_.push(std::move(vector));
}

void Machine::make_closure(uint32_t index) {
  for (Record& record : records_)
    if (record.unit != kNoUnit) record.is_pure = false;  // it could not be kept
  FunctionEntry& function = *frames_.back().code->functions[index];
  stack_.push(Value::adopt(new Closure(function, scope_, compiler_.names())));
}

void Machine::echo(const EchoSite& site) {
  std::string text;
  const auto count = static_cast<uint32_t>(site.names.size());
  for (uint32_t number = 0; number < count; ++number) {
    if (number) text += ", ";
    if (site.names[number] != kNoName) {
      text += compiler_.names().text(site.names[number]);
      text += " = ";
    }
    append_echo_text(text, stack_.below(count - 1 - number));
  }
  stack_.drop_to(stack_.size() - count);
  messages_.say(MessageGroup::kEcho, std::move(text));
}

void Machine::assert_top(const AssertSite& site, bool has_message) {
  const Value message = has_message ? stack_.pop() : Value::undef();
  if (stack_.pop().is_true()) return;
  std::string text = "Assertion";
  if (site.condition) {
    text += " '";
    append_expression_text(text, *site.condition, compiler_.names());
    text += "'";
  }
  text += " failed";
  if (has_message) text += ": " + echo_text(message);
  fail(std::move(text), place());
}

void Machine::duplicate_let(Name name) {
  warn("Ignoring duplicate variable assignment " + std::string(compiler_.names().text(name)) +
           " = " + echo_text(stack_.top()),
       PathBase::kUnit);
  stack_.drop();
}

void Machine::unnamed_let() {
  warn("Assignment without variable name " + echo_text(stack_.top()), PathBase::kUnit);
  stack_.drop();
}

}  // namespace language
