#include "evaluation/recorder.hpp"

#include <algorithm>

namespace language {
namespace {

uint32_t definitions_of(const Scope* scope) {
  return scope ? static_cast<uint32_t>(scope->functions.size() + scope->modules.size()) : 0;
}

uint32_t variables_of(const Scope* scope) {
  return scope ? static_cast<uint32_t>(scope->assignments.size()) : 0;
}

}  // namespace

Recorder::Recorder(const Program& program, const FunctionEnvironment& environment,
                   const DynamicNames& dynamic, const StepCount& steps)
    : environment_(environment),
      dynamic_(dynamic),
      steps_(steps),
      definitions_(definitions_of(program.units[0].scope)),
      variables_(variables_of(program.units[0].scope)),
      dependencies_(name_number(0) + program.names.size()) {}

Record& Recorder::begin(uint32_t unit) {
  dependencies_.begin();
  record_ = ++records_made_;
  return records_.emplace_back(Record{unit, dynamic_.trail(), environment_.messages.said(),
                                      environment_.files.finds(), steps_.steps(),
                                      environment_.module_names.size()});
}

void Recorder::end() {
  const Record record = records_.back();
  records_.pop_back();
  dependencies_.end([&](uint32_t number) {
    const uint32_t first_name = name_number(0);
    return number < first_name ||
           !dynamic_.is_bound_between(number - first_name, records_.back().trail, record.trail);
  });
  record_ = records_.empty() ? 0 : ++records_made_;
}

void Recorder::note(uint32_t number, Name name) {
  if (dependencies_.has(number) || dynamic_.is_bound_since(name, innermost().trail)) return;
  dependencies_.note(number);
}

void Recorder::note_new_code(const Code& code) {
  code.noted_by = record_;
  if (code.definition != kNoDefinition) note_definition(code.definition);
  for (const uint32_t slot : code.top_variables) note_variable(slot);
}

void Recorder::note_history() {
  for (Record& record : records_) record.is_pure = false;
}

void Recorder::note_result(const BuiltinFunction& function, std::span<const Value> arguments) {
  constexpr std::string_view kSuch[] = {"rands", "dxf_dim", "dxf_cross"};
  if (function.name == "parent_module") return note_parent(arguments);
  if (std::find(std::begin(kSuch), std::end(kSuch), function.name) != std::end(kSuch))
    note_history();
}

// A call depends on the names of those around it, not on those within.
void Recorder::note_parent(std::span<const Value> arguments) {
  const double level = arguments.empty()          ? 1
                       : arguments[0].is_number() ? arguments[0].number()
                                                  : -1;
  const auto modules = static_cast<double>(environment_.module_names.size());
  for (Record& record : records_) {
    record.is_pure =
        record.is_pure && level >= 0 && modules - 1 - level >= static_cast<double>(record.modules);
  }
}

void Recorder::note_closure() {
  for (Record& record : records_)
    if (record.unit != kNoUnit) record.is_pure = false;
}

bool Recorder::is_repeatable() const {
  const Record& record = innermost();
  return record.is_pure && record.messages == environment_.messages.said() &&
         record.finds == environment_.files.finds();
}

NamedValues Recorder::reads() const {
  NamedValues reads;
  const uint32_t first_name = name_number(0);
  dependencies_.for_each([&](uint32_t number) {
    if (number < first_name) return;
    const Name name = number - first_name;
    reads.emplace_back(name, dynamic_.value_at(name, innermost().trail));
  });
  return reads;
}

void Recorder::append_sources(std::vector<uint32_t>& definitions,
                              std::vector<uint32_t>& variables) const {
  dependencies_.for_each([&](uint32_t number) {
    if (number < definitions_) {
      definitions.push_back(number);
    } else if (number < name_number(0)) {
      variables.push_back(number - definitions_);
    }
  });
}

}  // namespace language
