// children() and child().
#include "evaluation/machine.hpp"
#include "values/make.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

constexpr uint32_t kRangeLimit = 10000;  // of a range of this count and more nothing is selected

// OpenSCAD cuts an index to a whole number.
double whole(double number) { return std::trunc(number); }

}  // namespace

const Activation* Machine::activation() const {
  const uint32_t number = frames_.back().activation;
  return number == kNoActivation ? nullptr : &activations_[number];
}

uint32_t Machine::child_count() const {
  const Activation* const module = activation();
  return module && module->block ? static_cast<uint32_t>(module->block->calls.size()) : 0;
}

void Machine::say_child_is_deprecated() {
  messages_.say(MessageGroup::kDeprecated,
                "child() will be removed in future releases. Use children() instead.");
}

// Children run where they are written: in the scope and among the children of their call.
void Machine::run_block(FrameKind kind, uint32_t child) {
  const Activation& module = *activation();
  if (frames_.size() >= kDepthLimit) {
    fail("Recursion detected calling module 'children'", place());
  }
  const Code& code = compiler_.code_of(*module.block);
  push_frame(code, stack_.size(), HeapScopes::acquire(module.block_scope), kind,
             module.block_activation);
  next_ = code.entries[child];
}

void Machine::all_children(const NodeSite& site) {
  begin_node(site);
  if (child_count()) run_block(FrameKind::kBlock, 0);
}

bool Machine::end_child(bool is_last) {
  const FrameKind kind = frames_.back().kind;
  if (kind == FrameKind::kBlock && !is_last) return false;
  stack_.drop_to(base_);
  dynamic_.undo(frames_.back().trail);
  pop_frame();
  return true;
}

// Appends a child's number if there is such a child.
void Machine::select_child(double index, bool is_child, Value& numbers) {
  const double number = whole(index);
  const std::string text = std::to_string(static_cast<int>(number));
  const uint32_t count = child_count();
  if (number >= 0 && number < count) return append_element(numbers, number);
  if (is_child) {
    const std::string problem = number < 0 ? "Negative child index (" + text + ") not allowed"
                                           : "Child index (" + text + ") out of bounds (" +
                                                 std::to_string(count) + " children)";
    return warn(problem, PathBase::kMainFile);
  }
  messages_.say(MessageGroup::kWarning, number < 0
                                            ? "Negative children index (" + text + ") not allowed"
                                            : "Children index (" + text + ") out of bounds (" +
                                                  std::to_string(count) + " children)");
}

void Machine::select_from_vector(const Value& indices, Value& numbers) {
  for (const Value& index : indices.elements()) {
    if (index.is_number()) {
      select_child(index.number(), false, numbers);
      continue;
    }
    std::string text;
    append_str_text(text, index);
    messages_.say(MessageGroup::kWarning,
                  "Bad parameter type (" + text +
                      ") for children, only accept: empty, number, vector, range.");
  }
}

bool Machine::select_from_range(const Value& value, Value& numbers) {
  const RangeObject& range = value.range();
  const uint32_t count = range.count();
  if (count >= kRangeLimit) {
    warn("Bad range parameter for children: too many elements (" + std::to_string(count) + ")",
         PathBase::kMainFile);
    return false;
  }
  for (uint32_t number = 0; number < range.steps(); ++number)
    select_child(range.value(number), false, numbers);
  return true;
}

bool Machine::select_children(const NodeSite& site, bool is_child) {
  const Value selection = stack_.pop();
  Value numbers = language::make_vector();
  bool is_group = false;
  if (selection.is_number() || is_child) {
    select_child(selection.is_number() ? selection.number() : 0, is_child, numbers);
  } else if (selection.is_vector()) {
    select_from_vector(selection, numbers);
    is_group = true;
  } else if (selection.is_range()) {
    is_group = select_from_range(selection, numbers);
    if (!is_group) return false;
  } else {
    warn("Bad parameter type (" + echo_text(selection) +
             ") for children, only accept: empty, number, vector, range",
         PathBase::kMainFile);
    return false;
  }
  if (!is_group && numbers.elements().empty()) return false;
  if (is_group) begin_node(site);
  stack_.push(std::move(numbers));
  stack_.push(0.0);
  stack_.push(Value::boolean(is_group));
  return true;
}

void Machine::next_child(uint32_t state, uint32_t after) {
  const auto numbers = stack_[state].elements();
  const auto done = static_cast<size_t>(stack_[state + 1].number());
  if (done == numbers.size()) {
    next_ = after;
    return;
  }
  stack_[state + 1] = done + 1.0;
  run_block(FrameKind::kChild, static_cast<uint32_t>(numbers[done].number()));
}

void Machine::end_selection() {
  const bool is_group = stack_.pop().boolean();
  stack_.drop();
  stack_.drop();
  if (is_group) end_node(false);
}

}  // namespace language
