// What parts of an evaluation depend on: the top levels of used files, and calls of modules.
#include <algorithm>

#include "evaluation/machine.hpp"

namespace language {

Record& Machine::begin_record(uint32_t unit) {
  dependencies_.begin();
  record_ = ++records_made_;
  return records_.emplace_back(Record{unit, dynamic_.trail(), messages_.said(),
                                      modules_.files.finds(), work(),
                                      static_cast<uint32_t>(module_names_.size())});
}

// What the part depended on, the part around it depends on, too, unless that has bound the `$`
// name.
void Machine::end_record() {
  const Record record = records_.back();
  records_.pop_back();
  dependencies_.end([&](uint32_t number) {
    const uint32_t first_name = read_number(0);
    return number < first_name ||
           !dynamic_.is_bound_between(number - first_name, records_.back().trail, record.trail);
  });
  record_ = records_.empty() ? 0 : ++records_made_;
}

void Machine::note_read(Name name) {
  const uint32_t number = read_number(name);
  if (dependencies_.has(number) || dynamic_.is_bound_since(name, records_.back().trail)) return;
  dependencies_.note(number);
}

void Machine::note_code(const Code& code) {
  code.noted_by = record_;
  if (code.definition != kNoDefinition) dependencies_.note(code.definition);
  for (const uint32_t slot : code.top_variables) dependencies_.note(variable_number(slot));
}

// What depends on what has happened before in the run.
void Machine::note_history() {
  for (Record& record : records_) record.is_pure = false;
}

// Functions whose results differ from call to call, or with a file.
void Machine::note_builtin(const BuiltinFunction& function, std::span<const Value> arguments) {
  constexpr std::string_view kSuch[] = {"rands", "dxf_dim", "dxf_cross"};
  if (function.name == "parent_module") return note_parent(arguments);
  if (std::find(std::begin(kSuch), std::end(kSuch), function.name) != std::end(kSuch))
    note_history();
}

// A call depends on the names of those around it, not on those within.
void Machine::note_parent(std::span<const Value> arguments) {
  const double level = arguments.empty()          ? 1
                       : arguments[0].is_number() ? arguments[0].number()
                                                  : -1;
  const auto modules = static_cast<double>(module_names_.size());
  for (Record& record : records_)
    record.is_pure = record.is_pure && level >= 0 && modules - 1 - level >= record.modules;
}

bool Machine::has_said_nothing(const Record& record) const {
  return record.messages == messages_.said();
}

// Returns the `$` names that others had bound, with their values when the record began.
NamedValues Machine::noted_reads(const Record& record) const {
  NamedValues reads;
  const uint32_t first_name = read_number(0);
  dependencies_.for_each([&](uint32_t number) {
    if (number < first_name) return;
    const Name name = number - first_name;
    reads.emplace_back(name, dynamic_.value_at(name, record.trail));
  });
  return reads;
}

}  // namespace language
