#include "evaluation/call_stack.hpp"

#include <algorithm>
#include <utility>

#include "values/value_text.hpp"

namespace language {
namespace {

constexpr uint32_t kTailLimit = 1000000;
constexpr int64_t kMostNestedBytes = int64_t{96} << 20, kMostRoundsBytes = int64_t{256} << 20;

}  // namespace

CallStack::CallStack(const Program& program, FunctionEnvironment& environment, const NodeTree& tree,
                     std::stop_token stop)
    : steps(std::move(stop), tree),
      dynamic(program.names.size()),
      recorder(program.names.size(), environment, dynamic),
      program_(program),
      environment_(environment) {
  set_unit(0);
}

inline void CallStack::enter(const Code& code, uint32_t next, uint32_t base, HeapScope* scope) {
  instructions_ = code.instructions.data();
  next_ = next;
  base_ = base;
  scope_ = scope;
  if (code.unit != unit_) set_unit(code.unit);
}

void CallStack::push(const Code& code, uint32_t base, HeapScope* scope, FrameKind kind,
                     uint32_t activation) {
  steps.count();
  values.reserve(base + code.deepest + 1);  // before the frame, so that errors have their place
  if (!frames_.empty()) {
    frames_.back().next = next_;
    frames_.back().scope = scope_;
  }
  frames_.push_back({&code, 0, base, scope, dynamic.trail(), activation, object_memory.used, kind});
  enter(code, 0, base, scope);
}

void CallStack::replace(const Code& code, uint32_t slots, HeapScope* scope) {
  values.reserve(std::max(base_ + code.deepest + 1, values.size()));
  const uint32_t first = values.size() - slots;
  for (uint32_t slot = 0; slot < slots; ++slot)
    values[base_ + slot] = std::move(values[first + slot]);
  values.drop_to(base_ + slots);
  HeapScope* const before = scope_;
  Frame& frame = frames_.back();
  frame.code = &code;
  frame.scope = scope;
  enter(code, 0, base_, scope);
  HeapScopes::release(before);
}

void CallStack::pop() {
  HeapScopes::release(scope_);
  frames_.pop_back();
  scope_ = nullptr;
  if (frames_.empty()) return;
  const Frame& frame = frames_.back();
  enter(*frame.code, frame.next, frame.base, frame.scope);
}

// What the inner half of the calls has made is the recursion's, not that of the design around it.
bool CallStack::takes_too_much() const {
  if (depth() >= kDepthLimit) return true;
  return object_memory.used - frames_[depth() / 2].memory > kMostNestedBytes;
}

bool CallStack::loops_too_long() {
  steps.count();
  Frame& frame = frames_.back();
  const bool grows =
      ++frame.rounds > kFewCalls && object_memory.used - frame.memory > kMostRoundsBytes;
  return frame.rounds > kTailLimit || grows;
}

HeapScope* CallStack::scope_at(uint32_t number) const {
  HeapScope* scope = scope_;
  for (; number; --number) scope = scope->parent;
  return scope;
}

void CallStack::pop_scope() {
  HeapScope* const scope = scope_;
  scope_ = HeapScopes::acquire(scope->parent);
  leave_scope(scope);
}

void CallStack::renew_scope() {
  HeapScope* const before = scope_;
  if (before->references == 1) return;
  scope_ = scopes.make(HeapScopes::acquire(before->parent), before->size);
  for (uint32_t slot = 0; slot < before->size; ++slot)
    scope_->values()[slot] = before->values()[slot];
  leave_scope(before);
}

std::string CallStack::text_of(const Expression& callee) const {
  std::string text = "(";
  append_expression_text(text, callee, program_.names);
  return text + ")";
}

void CallStack::fail(std::string text, Place place) {
  environment_.messages.say(MessageGroup::kError, std::move(text), place, PathBase::kUnit);
  say_traces();
  throw Aborted();
}

void CallStack::fail_recursion(const char* kind, std::string_view name, Place place) {
  fail("Recursion detected calling " + std::string(kind) + " '" + std::string(name) + "'", place);
}

void CallStack::say_trace(std::string text, Place place) {
  environment_.messages.say(MessageGroup::kTrace, std::move(text), place, PathBase::kUnit);
}

void CallStack::say_traces() {
  frames_.back().next = next_;
  uint32_t count = 0;
  const Frame* callee = nullptr;  // the frame that the next call region has called
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    set_unit(frame->code->unit);
    for (const TraceRegion& region : frame->code->regions) {
      if (frame->next <= region.begin || frame->next > region.end || region.is_tail) continue;
      if (++count > most_traces_) return;
      // The call that has begun the callee anew counts in place of the first one.
      const TraceRegion* const tail =
          callee && !region.is_assignment ? tail_call(*std::exchange(callee, nullptr)) : nullptr;
      const TraceRegion& told = tail ? *tail : region;
      const std::string name =
          told.callee && told.name.empty() ? text_of(*told.callee) : std::string(told.name);
      const bool has_overwritten = told.overwritten.file != kNoFile;
      const std::string of_name = "assignment to \"" + name + "\"";
      if (has_overwritten) {
        say_trace("overwritten " + of_name + " (this is where the assignment is evaluated)",
                  told.overwritten);
      }
      say_trace(!region.is_assignment ? "called by '" + name + "'"
                : has_overwritten     ? "overwriting " + of_name
                                      : of_name,
                told.place);
    }
    callee = frame->kind == FrameKind::kFunction ? &*frame : nullptr;
    if (!program_.dialect.has_full_traces || !traces_parameters_ ||
        frame->kind != FrameKind::kModule || frame->next <= frame->code->statements)
      continue;
    if (++count > most_traces_) return;
    say_trace("call of '" + call_text(*frame) + "'", frame->call);
  }
}

/// Returns the call in tail position that has begun a function's frame anew last; null: none has.
const TraceRegion* CallStack::tail_call(const Frame& frame) const {
  if (!frame.tail_code) return nullptr;
  for (const TraceRegion& region : frame.tail_code->regions)
    if (region.is_tail && frame.tail_next > region.begin && frame.tail_next <= region.end)
      return &region;
  return nullptr;
}

std::string CallStack::call_text(const Frame& frame) {
  std::string text = text_of(frame.callee->name) + "(";
  const char* before = "";
  for (const Target& parameter : frame.callee->parameters.targets) {  // twice if it is listed twice
    if (parameter.is_dynamic) continue;
    text += std::exchange(before, ", ") + text_of(parameter.name) + " = ";
    append_quoted_text(text, values[frame.base + parameter.slot]);
  }
  return text + ")";
}

void CallStack::set_unit(uint32_t unit) {
  unit_ = unit;
  environment_.messages.set_unit_folder(program_.shown_folder(unit));
  environment_.files.set_unit_folder(program_.units[unit].folder);
}

}  // namespace language
