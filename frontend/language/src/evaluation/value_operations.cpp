#include "evaluation/value_operations.hpp"

#include <string>

#include "base/utf8.hpp"
#include "language/make.hpp"
#include "values/members_object.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

// Ranges of this count and more are refused.
constexpr uint32_t kElementLimit = 1000000;
constexpr double kRoundLimit = 1000000;  // of a C-style for

// Bytes at the end that are cut off are no character; openscad never ends there.
void append_characters(Value& vector, std::string_view text) {
  for (; const size_t length = code_point_length(text); text.remove_prefix(length)) {
    count_work();
    append_element(vector, make_string(text.substr(0, length)));
  }
}

Value keys_of(const MembersObject& object) {
  const auto members = object.keys_and_values();
  count_work(members.size());
  Value keys = language::make_vector(object.size());
  for (size_t i = 0; i < members.size(); i += 2) append_in_room(keys, members[i]);
  return keys;
}

}  // namespace

void ValueOperations::push_dynamic(Name name, bool silently) {
  const Value& value = stack_.dynamic[name];
  stack_.recorder.note_read(name);
  if (value.is_set()) return values_.push_copy(value);
  if (!silently) return unknown_variable(name);
  values_.push(Value::undef());
}

void ValueOperations::unknown_variable(Name name) {
  const bool is_special = compiler_.names().is_dynamic(name);
  const bool is_child_count = name == compiler_.known().child_count;
  stack_.warn(filled(compiler_.dialect().unknown_variable, {stack_.text_of(name)}),
              is_special && !is_child_count ? PathBase::kUnit : PathBase::kMainFile);
  values_.push(Value::undef());
}

// With the flag, a value that is not set leaves the variable as it is.
void ValueOperations::store_scoped(const Instruction& step) {
  Value value = values_.pop();
  if (step.flag && !value.is_set()) return;
  stack_.scope_at(step.a)->values()[step.b] = std::move(value);
}

void ValueOperations::say(const OperatorProblem& problem) {
  if (!problem.unplaced.empty()) stack_.messages().say(MessageGroup::kWarning, problem.unplaced);
  if (!problem.text.empty()) stack_.warn(problem.text, PathBase::kUnit);
}

void ValueOperations::binary(Value (*op)(const Value&, const Value&, OperatorProblem&)) {
  const OperationLimit limit;
  const Value left = values_.pop();
  OperatorProblem problem;
  values_.top() = op(left, values_.top(), problem);
  if (!problem.text.empty()) say(problem);
}

void ValueOperations::unary(Value (*op)(const Value&, OperatorProblem&)) {
  const OperationLimit limit;
  OperatorProblem problem;
  values_.top() = op(values_.top(), problem);
  if (!problem.text.empty()) say(problem);
}

void ValueOperations::make_range(uint16_t flags) {
  if (!(flags & kHasStep) && compiler_.dialect().swaps_reversed_ranges) {
    const Value end = values_.pop();
    RangeProblem problem;
    values_.top() = range_of(values_.top(), end, problem);
    if (problem.is_reversed) {
      stack_.messages().say(
          MessageGroup::kDeprecated,
          "Using ranges of the form [begin:end] with begin value greater than the end "
          "value is deprecated",
          stack_.place(), PathBase::kUnit);
    }
    return;
  }
  const Value step = flags & kHasStep ? values_.pop() : Value(1.0);
  const Value end = values_.pop();
  const Value begin = values_.pop();
  values_.push(range_of(begin, step, end, compiler_.dialect().has_nearest_integers));
  if (!(flags & kChecksDirection) || !values_.top().is_range()) return;
  if (step.number() > 0 && end.number() < begin.number())
    stack_.warn("begin is greater than the end, but step is positive", PathBase::kUnit);
  if (step.number() < 0 && end.number() > begin.number())
    stack_.warn("begin is smaller than the end, but step is negative", PathBase::kUnit);
}

void ValueOperations::make_vector(uint32_t count) {
  Value vector = language::make_vector(count);
  auto& object = static_cast<VectorObject&>(*vector.object());
  values_.pop_to(object.elements(), count);
  object.take_appended(count);
  values_.push(std::move(vector));
}

void ValueOperations::make_closure(uint32_t index) {
  stack_.recorder.note_history();
  FunctionEntry& function = *stack_.code().functions[index];
  values_.push(Value::adopt(new Closure(function, stack_.scope(), compiler_.names())));
}

void ValueOperations::echo(const EchoSite& site) {
  std::string text;
  const auto count = static_cast<uint32_t>(site.names.size());
  for (uint32_t number = 0; number < count; ++number) {
    if (number) text += ", ";
    if (site.names[number] != kNoName) {
      text += compiler_.names().text(site.names[number]);
      text += " = ";
    }
    append_echo_text(text, values_.below(count - 1 - number));
  }
  values_.drop_to(values_.size() - count);
  stack_.messages().say(MessageGroup::kEcho, std::move(text));
}

void ValueOperations::assert_top(const AssertSite& site, bool has_message) {
  const Value message = has_message ? values_.pop() : Value::undef();
  if (values_.pop().is_true()) return;
  std::string text = "Assertion";
  if (site.condition) {
    text += " '";
    append_expression_text(text, *site.condition, compiler_.names());
    text += "'";
  }
  text += " failed";
  if (has_message) text += ": " + echo_text(message);
  stack_.fail(std::move(text), stack_.place());
}

void ValueOperations::duplicate_let(Name name) {
  stack_.warn(filled(compiler_.dialect().duplicate_assignment,
                     {stack_.text_of(name), echo_text(values_.top())}),
              PathBase::kUnit);
  values_.drop();
}

void ValueOperations::unnamed_let() {
  stack_.warn("Assignment without variable name " + echo_text(values_.top()), PathBase::kUnit);
  values_.drop();
}

void ValueOperations::too_many(uint32_t count) {
  stack_.warn(
      "Bad range parameter in for statement: too many elements (" + std::to_string(count) + ")",
      PathBase::kUnit);
}

void ValueOperations::begin_loop(uint16_t kind) {
  Value& source = values_.top();
  if (source.is_range()) {
    const uint32_t count = source.range().count();
    if (count >= (kind == kStatementLoop ? compiler_.dialect().too_many_rounds : kElementLimit)) {
      too_many(count);
      source = language::make_vector();
    }
  } else if (source.is_undef()) {
    source = language::make_vector();
  } else if (source.is_object()) {
    source = keys_of(source.members());
  } else if (source.is_string()) {
    Value characters = language::make_vector();
    append_characters(characters, source.text());
    source = std::move(characters);
  } else if (!source.is_vector()) {
    Value single = language::make_vector(1);
    append_element(single, std::move(source));
    source = std::move(single);
  }
  const double rounds =
      source.is_vector() ? static_cast<double>(source.elements().size()) : source.range().steps();
  values_.push(0.0);
  values_.push(rounds);
}

bool ValueOperations::next_round(uint32_t slot) {
  stack_.steps.count();
  const Value& source = stack_.slot(slot);
  Value& done = stack_.slot(slot + 1);
  if (!(done.number() < stack_.slot(slot + 2).number())) return false;
  const auto number = static_cast<uint32_t>(done.number());
  if (source.is_vector()) {
    values_.push_copy(source.elements()[number]);
  } else {
    values_.push(source.range().value(number));
  }
  done = number + 1.0;
  return true;
}

void ValueOperations::append_expanded(Value& vector, const Value& value) {
  if (value.is_vector()) {
    append_elements(vector, value.elements());
  } else if (value.is_string()) {
    append_characters(vector, value.text());
  } else if (value.is_range()) {
    const uint32_t count = value.range().count();
    if (count >= kElementLimit) return too_many(count);
    for (uint32_t number = 0; number < value.range().steps(); ++number)
      append_element(vector, value.range().value(number));
  } else if (!value.is_undef()) {
    append_element(vector, value);
  }
}

void ValueOperations::append_each(uint32_t slot) {
  const Value value = values_.pop();
  append_expanded(stack_.slot(slot), value);
}

void ValueOperations::append_each_of_all(uint32_t slot) {
  const Value values = values_.pop();
  for (const Value& value : values.elements()) append_expanded(stack_.slot(slot), value);
}

void ValueOperations::count_round(uint32_t slot) {
  stack_.steps.count();
  Value& rounds = stack_.slot(slot);
  if (rounds.number() >= kRoundLimit)
    stack_.fail("For loop counter exceeded limit", stack_.place());
  rounds = rounds.number() + 1;
}

}  // namespace language
