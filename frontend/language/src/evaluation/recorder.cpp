#include "evaluation/recorder.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace language {

void Recorder::begin(uint32_t unit) {
  dependencies_.begin();
  records_.push_back(
      {unit, dynamic_.trail(), environment_.messages.said(), environment_.files.finds()});
}

void Recorder::end() {
  const Record record = records_.back();
  records_.pop_back();
  dependencies_.end([&](Name name) {
    return !dynamic_.is_bound_between(name, records_.back().trail, record.trail);
  });
}

void Recorder::note(Name name) {
  if (dependencies_.has(name) || dynamic_.is_bound_since(name, innermost().trail)) return;
  dependencies_.note(name);
}

void Recorder::note_history() {
  for (Record& record : records_) record.is_pure = false;
}

void Recorder::note_result(const BuiltinFunction& function) {
  constexpr std::string_view kSuch[] = {"rands", "dxf_dim", "dxf_cross", "parent_module"};
  if (std::find(std::begin(kSuch), std::end(kSuch), function.name) != std::end(kSuch))
    note_history();
}

bool Recorder::is_repeatable() const {
  const Record& record = innermost();
  return record.is_pure && record.messages == environment_.messages.said() &&
         record.finds == environment_.files.finds();
}

NamedValues Recorder::reads() const {
  NamedValues reads;
  dependencies_.for_each(
      [&](Name name) { reads.emplace_back(name, dynamic_.value_at(name, innermost().trail)); });
  return reads;
}

}  // namespace language
