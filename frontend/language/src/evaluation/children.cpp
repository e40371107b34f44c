// children() and child().
#include <limits>

#include "base/evaluation_thread.hpp"
#include "evaluation/machine.hpp"
#include "language/make.hpp"
#include "values/range.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

constexpr uint32_t kRangeLimit = 10000;  // of a range of this count and more nothing is selected

constexpr size_t kWorkOfMessage = 128;  // about a child that is not there, which takes some 500 ns

// Cuts to a whole number as C does on this processor: the least one for all that does not fit.
int whole(double number) {
  const bool fits = number > -2147483649.0 && number < 2147483648.0;
  return fits ? static_cast<int>(number) : std::numeric_limits<int>::min();
}

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
  if (nests_too_deeply()) {
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

// Returns whether there is a child of that number, and says if not.
bool Machine::is_child_number(int number, bool is_child) {
  if (number >= 0 && static_cast<uint32_t>(number) < child_count()) return true;
  if (number >= 0 && !activation()) return false;
  const std::string text = std::to_string(number);
  const std::string count = std::to_string(child_count());
  if (is_child) {
    warn(number < 0 ? "Negative child index (" + text + ") not allowed"
                    : "Child index (" + text + ") out of bounds (" + count + " children)",
         PathBase::kMainFile);
  } else {
    messages_.say(MessageGroup::kWarning,
                  number < 0
                      ? "Negative children index (" + text + ") not allowed"
                      : "Children index (" + text + ") out of bounds (" + count + " children)");
  }
  return false;
}

bool Machine::select_children(const NodeSite& site, bool is_child) {
  Value selection = stack_.pop();
  bool is_group = false;
  if (selection.is_number() || is_child) {
    const int number = whole(selection.is_number() ? selection.number() : 0);
    if (!is_child_number(number, is_child)) return false;
    selection = language::make_vector(1);
    append_element(selection, static_cast<double>(number));
  } else if (selection.is_vector() || selection.is_range()) {
    is_group = true;
  } else {
    warn("Bad parameter type (" + echo_text(selection) +
             ") for children, only accept: empty, number, vector, range",
         PathBase::kMainFile);
    return false;
  }
  if (selection.is_range() && selection.range().count() >= kRangeLimit) {
    warn("Bad range parameter for children: too many elements (" +
             std::to_string(selection.range().count()) + ")",
         PathBase::kMainFile);
    return false;
  }
  if (is_group) begin_node(site);
  stack_.push(std::move(selection));
  stack_.push(0.0);
  stack_.push(Value::boolean(is_group));
  return true;
}

// The number of the next child; unset after the last.
Value Machine::next_selected(uint32_t state) {
  const Value& selection = stack_[state];
  const auto done = static_cast<uint32_t>(stack_[state + 1].number());
  stack_[state + 1] = done + 1.0;
  if (selection.is_range()) {
    if (done >= selection.range().steps()) return Value::unset();
    return selection.range().value(done);
  }
  return done < selection.elements().size() ? selection.elements()[done] : Value::unset();
}

void Machine::next_child(uint32_t state, uint32_t after) {
  for (;;) {
    count_work(kWorkOfMessage);
    const Value index = next_selected(state);
    if (!index.is_set()) {
      next_ = after;
      return;
    }
    if (!index.is_number()) {
      std::string text;
      append_str_text(text, index);
      messages_.say(MessageGroup::kWarning,
                    "Bad parameter type (" + text +
                        ") for children, only accept: empty, number, vector, range.");
    } else if (is_child_number(whole(index.number()), false)) {
      return run_block(FrameKind::kChild, static_cast<uint32_t>(index.number()));
    }
  }
}

void Machine::end_selection() {
  const bool is_group = stack_.pop().boolean();
  stack_.drop();
  stack_.drop();
  if (is_group) end_node(false);
}

}  // namespace language
