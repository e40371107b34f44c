// Function calls by name, and the frames of all calls.
#include "evaluation/machine.hpp"
#include "evaluation/operation_limit.hpp"
#include "syntax/syntax.hpp"
#include "values/object_memory.hpp"

namespace language {
namespace {

constexpr uint32_t kTailLimit = 1000000;
// A recursion that goes on for longer than these calls, and makes more than these bytes of values
// that last, is endless: it would only end when it has taken all memory. OpenSCAD allows some 8,600
// nested calls, so that each of them would have to keep some thousand numbers.
constexpr size_t kFewCalls = 3000;
constexpr int64_t kMostNestedBytes = int64_t{96} << 20, kMostRoundsBytes = int64_t{256} << 20;

}  // namespace

// Takes over a reference to `scope`.
void Machine::push_frame(const Code& code, uint32_t base, HeapScope* scope, FrameKind kind,
                         uint32_t activation) {
  count_step();
  stack_.reserve(base + code.deepest + 1);  // before the frame, so that errors have their place
  if (!frames_.empty()) {
    frames_.back().next = next_;
    frames_.back().scope = scope_;
  }
  frames_.push_back({&code, 0, base, scope, dynamic_.trail(), activation, object_memory.used});
  frames_.back().kind = kind;
  if (code.noted_by != record_ && record_ != 0) note_code(code);
  code_ = code.instructions.data();
  next_ = 0;
  base_ = base;
  scope_ = scope;
  if (code.unit != unit_) set_unit(code.unit);
}

void Machine::pop_frame() {
  HeapScopes::release(scope_);
  frames_.pop_back();
  if (frames_.empty()) {
    scope_ = nullptr;
    return;
  }
  const Frame& frame = frames_.back();
  code_ = frame.code->instructions.data();
  next_ = frame.next;
  base_ = frame.base;
  scope_ = frame.scope;
  if (frame.code->unit != unit_) set_unit(frame.code->unit);
}

uint32_t Machine::push_parameters(const Callable& callable) {
  const uint32_t base = stack_.size();
  stack_.reserve(base + static_cast<uint32_t>(callable.initial.size()));
  for (const Value& value : callable.initial) stack_.push_copy(value);
  return base;
}

void Machine::begin_call(const CallSite& site) {
  Callable& callable =
      site.module ? static_cast<Callable&>(*site.module) : static_cast<Callable&>(*site.function);
  const uint32_t base = push_parameters(callable);
  if (!callable.has_default_code) return;
  HeapScope* const scope = site.is_in_unit ? unit_scopes_.back() : scope_at(site.scope);
  push_frame(compiler_.defaults_of(callable, site.module), base, HeapScopes::acquire(scope),
             FrameKind::kDefaults, kNoActivation);
}

void Machine::return_defaults() {
  const FrameKind kind = frames_.back().kind;
  const uint32_t base = base_;
  pop_frame();
  if (kind == FrameKind::kDynamicDefaults) keep_defaults(base);
}

// Returns whether the calls nest too deeply for another one. What the inner half of them has made
// is the recursion's, not that of the design around it.
bool Machine::nests_too_deeply() const {
  const size_t depth = frames_.size();
  if (depth >= kDepthLimit) return true;
  return depth > kFewCalls && object_memory.used - frames_[depth / 2].memory > kMostNestedBytes;
}

void Machine::recursion_in_function(std::string_view name, Place place) {
  fail("Recursion detected calling function '" + std::string(name) + "'", place);
}

void Machine::call_function(const CallSite& site) {
  FunctionEntry& function = *site.function;
  if (nests_too_deeply()) recursion_in_function(compiler_.names().text(function.name), place());
  HeapScope* const scope = take_scope(site);
  const Code& code = compiler_.code_of(function);
  const uint32_t base = stack_.size() - site.slots;
  push_frame(code, base, scope, FrameKind::kFunction, kNoActivation);
  frames_.back().function = &function;
  for (uint32_t slot = site.slots; slot < code.slots; ++slot) stack_.push(Value::unset());
}

void Machine::return_value() {
  Value value = stack_.pop();
  stack_.drop_to(base_);
  dynamic_.undo(frames_.back().trail);
  pop_frame();
  stack_.push(std::move(value));
}

void Machine::tail_jump(uint32_t slots, uint32_t target) {
  count_step();
  Frame& frame = frames_.back();
  const bool grows =
      ++frame.rounds > kFewCalls && object_memory.used - frame.memory > kMostRoundsBytes;
  if (frame.rounds > kTailLimit || grows) {
    const bool is_named = frame.called_as == kNoName;
    const Name name = is_named ? frame.function->name : frame.called_as;
    recursion_in_function(compiler_.names().text(name),
                          is_named ? frame.function->place : frame.call);
  }
  stack_.drop_to(base_ + slots);
  next_ = target;
}

void Machine::call_builtin(uint32_t index, uint32_t count) {
  const BuiltinFunction& function = builtin_functions_[index];
  functions_.module_names = module_names_;
  const std::span<Value> arguments(stack_.end() - count, count);
  if (!records_.empty()) note_builtin(function, arguments);
  const OperationLimit limit;
  Value value = function.call({function.name, count, arguments, place(), functions_});
  stack_.drop_to(stack_.size() - count);
  stack_.push(std::move(value));
}

void Machine::next_lazy(const LazyCall& site) {
  const BuiltinFunction& function = builtin_functions_[site.builtin];
  const uint32_t base = base_ + site.slot;
  const auto count = static_cast<uint32_t>(stack_[base].number());
  const std::span<Value> arguments(&stack_[base + 1], count);
  if (!records_.empty()) note_builtin(function, arguments);
  const FunctionCall call{function.name, site.written, arguments,
                          place(),       functions_,   site.argument_names};
  const size_t next = count == site.room ? kNoArgument : function.next_argument(call);
  if (next != kNoArgument) {
    next_ = site.argument_code[next];
    return;
  }
  functions_.module_names = module_names_;
  const OperationLimit limit;
  Value value = function.call(call);
  stack_.drop_to(base);
  stack_.push(std::move(value));
}

void Machine::keep_lazy(const LazyCall& site) {
  Value value = stack_.pop();
  Value& count = stack_[base_ + site.slot];
  const auto number = static_cast<uint32_t>(count.number());
  stack_[base_ + site.slot + 1 + number] = std::move(value);
  count = number + 1.0;
}

void Machine::warn_count(Name name) {
  warn(std::string(compiler_.names().text(name)) + "() number of parameters does not match",
       PathBase::kMainFile);
  stack_.push(Value::undef());
}

void Machine::unknown_function(Name name) {
  warn("Ignoring unknown function '" + std::string(compiler_.names().text(name)) + "'",
       PathBase::kMainFile);
  stack_.push(Value::undef());
}

// A call in tail position says them once in the whole run.
void Machine::say_argument_warnings(uint32_t plan, bool once) {
  const Code& code = *frames_.back().code;
  if (once) {
    note_history();
    if (code.said.empty()) code.said.resize(code.plans.size());
    if (code.said[plan]) return;
    code.said[plan] = true;
  }
  for (const ArgumentWarning& warning : code.plans[plan].warnings)
    messages_.warn(warning.text, warning.place, PathBase::kUnit);
}

}  // namespace language
