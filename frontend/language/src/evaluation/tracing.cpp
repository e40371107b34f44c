// Messages with their places, errors with their traces, limits.
#include "evaluation/machine.hpp"
#include "language/stopped.hpp"
#include "syntax/syntax.hpp"
#include "values/object_memory.hpp"

namespace language {
namespace {

constexpr int kTraceLimit = 12;  // lines per error
// Instructions that count between two looks at the clock: well below the 50 ms in which an
// evaluation has to stop.
constexpr uint32_t kStepsPerCheck = 4096;

}  // namespace

void Machine::warn(std::string text, PathBase base) {
  messages_.warn(std::move(text), place(), base);
}

void Machine::fail(std::string text, Place place) {
  messages_.say(MessageGroup::kError, std::move(text), place, PathBase::kUnit);
  say_traces();
  throw Aborted();
}

std::string Machine::callee_text(const Expression& callee) const {
  std::string text = "(";
  append_expression_text(text, callee, compiler_.names());
  return text + ")";
}

// The calls that enclose the place where the evaluation has come to, from inside out.
void Machine::say_traces() {
  frames_.back().next = next_;
  int count = 0;
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    set_unit(frame->code->unit);
    for (const TraceRegion& region : frame->code->regions) {
      if (frame->next <= region.begin || frame->next > region.end) continue;
      if (++count > kTraceLimit) return;
      const std::string name = region.callee && region.name.empty() ? callee_text(*region.callee)
                                                                    : std::string(region.name);
      messages_.say(MessageGroup::kTrace, "called by '" + name + "'", region.place,
                    PathBase::kUnit);
    }
  }
}

void Machine::set_unit(uint32_t unit) {
  unit_ = unit;
  messages_.set_unit_folder(compiler_.program().units[unit].folder);
  modules_.files.set_unit_folder(compiler_.program().units[unit].folder);
}

void Machine::check_limits() {
  steps_ = kStepsPerCheck;
  counted_ += kStepsPerCheck;
  if (stop_.stop_requested()) throw Stopped();
  if (tree_.bytes() > static_cast<size_t>(object_memory.limit)) throw OutOfValueMemory();
}

}  // namespace language
