// Loops: over ranges, vectors, strings and single values.
#include "base/evaluation_thread.hpp"
#include "base/utf8.hpp"
#include "evaluation/machine.hpp"
#include "language/make.hpp"
#include "values/range.hpp"

namespace language {
namespace {

// Ranges of this count and more are refused.
constexpr uint32_t kStatementLimit = 10000, kElementLimit = 1000000;
constexpr double kRoundLimit = 1000000;  // of a C-style for

// Bytes at the end that are cut off are no character; openscad never ends there.
void append_characters(Value& vector, std::string_view text) {
  for (; const size_t length = code_point_length(text); text.remove_prefix(length)) {
    count_work();
    append_element(vector, make_string(text.substr(0, length)));
  }
}

}  // namespace

void Machine::too_many(uint32_t count) {
  warn("Bad range parameter in for statement: too many elements (" + std::to_string(count) + ")",
       PathBase::kUnit);
}

void Machine::begin_loop(uint16_t kind) {
  Value& source = stack_.top();
  if (source.is_range()) {
    const uint32_t count = source.range().count();
    if (count >= (kind == kStatementLoop ? kStatementLimit : kElementLimit)) {
      too_many(count);
      source = language::make_vector();
    }
  } else if (source.is_undef()) {
    source = language::make_vector();
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
  stack_.push(0.0);
  stack_.push(rounds);
}

bool Machine::next_round(uint32_t state) {
  count_step();
  const Value& source = stack_[state];
  Value& done = stack_[state + 1];
  if (!(done.number() < stack_[state + 2].number())) return false;
  const auto number = static_cast<uint32_t>(done.number());
  if (source.is_vector()) {
    stack_.push_copy(source.elements()[number]);
  } else {
    stack_.push(source.range().value(number));
  }
  done = number + 1.0;
  return true;
}

void Machine::append_expanded(Value& vector, const Value& value) {
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

void Machine::append_each(uint32_t slot) {
  const Value value = stack_.pop();
  append_expanded(stack_[base_ + slot], value);
}

void Machine::append_each_of_all(uint32_t slot) {
  const Value values = stack_.pop();
  for (const Value& value : values.elements()) append_expanded(stack_[base_ + slot], value);
}

void Machine::count_round(uint32_t slot) {
  count_step();
  Value& rounds = stack_[base_ + slot];
  if (rounds.number() >= kRoundLimit) fail("For loop counter exceeded limit", place());
  rounds = rounds.number() + 1;
}

}  // namespace language
