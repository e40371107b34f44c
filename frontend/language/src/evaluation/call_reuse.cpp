// Calls of modules whose nodes follow from what they followed from in an earlier evaluation: they
// are copied (language/evaluation_cache.hpp).
#include <algorithm>
#include <functional>

#include "base/name_table.hpp"
#include "evaluation/machine.hpp"
#include "values/copies.hpp"
#include "values/object_memory.hpp"

namespace language {
namespace {

/// What takes fewer steps is evaluated as fast as it is found.
constexpr uint64_t kLeastWork = 16;

/// The elements and bytes of a top level's variable that is kept, at most.
constexpr size_t kMostKept = 100'000;

void add(uint64_t& hash, uint64_t number) { hash = mix_hash(hash, number); }

// Looks at a part of a large value only.
void add_value(uint64_t& hash, const Value& value, int depth) {
  constexpr int kMostDepth = 3;
  constexpr size_t kMostElements = 16;
  add(hash, static_cast<uint64_t>(value.type()));
  if (value.is_number()) {
    add(hash, std::hash<double>()(value.number()));
  } else if (value.type() == ValueType::kBool) {
    add(hash, value.boolean());
  } else if (value.is_string()) {
    add(hash, std::hash<std::string_view>()(value.text()));
  } else if (value.is_vector()) {
    add(hash, value.elements().size());
    if (depth == kMostDepth) return;
    for (const Value& element :
         value.elements().first(std::min(value.elements().size(), kMostElements)))
      add_value(hash, element, depth + 1);
  }
}

// A module of the main unit is known by its definition, one of a used file by its place.
uint64_t number_of(const ModuleEntry& module) {
  constexpr uint64_t kIsPlace = uint64_t{1} << 63;
  if (module.scope->unit == 0) return module.definition;
  return kIsPlace | uint64_t{module.place.file} << 32 | module.place.offset;
}

uint64_t hash_of(const ModuleEntry& module, std::span<const Value> arguments) {
  uint64_t hash = number_of(module);
  for (size_t slot = 0; slot < arguments.size(); ++slot) {
    if (!arguments[slot].is_set()) continue;
    add(hash, module.parameters.slot_names[slot]);
    add_value(hash, arguments[slot], 0);
  }
  return hash;
}

/// Adds copies of set values. Returns whether all could be copied.
bool add_copy(NamedValues& copies, Name name, const Value& value, ValueCopier& copier) {
  copies.emplace_back(name, copier.copy(value));
  return copies.back().second.is_set() || !value.is_set();
}

}  // namespace

void Machine::use_calls(const KeptCalls& earlier) {
  const Program& program = compiler_.program();
  keeps_calls_ = true;
  calls_.structure = program_structure(program);
  calls_.definitions = definition_texts(program);
  if (earlier.tree && earlier.structure == calls_.structure)
    earlier_calls_.emplace(earlier, calls_.definitions, program.files);
}

// Whether a call may be kept: its code runs no block of another call's, and sees no scopes around
// it but a top level, whose variables are known to depend on nothing but its text if it is a used
// file's.
bool Machine::is_kept(const CallSite& site, const HeapScope* scope) const {
  const ScopeLayout& around = *site.module->scope;
  if (site.block || around.parent) return false;
  if (around.unit == 0) return true;
  const KeptUnit& unit = kept_units_[around.unit];
  return unit.scope == scope && unit.reads.empty();
}

// Begins a call whose node is open, and whose arguments are on top. Returns true if it has ended,
// as its nodes were copied.
bool Machine::begin_kept_call(const CallSite& site) {
  const ModuleEntry& module = *site.module;
  const std::span<const Value> arguments(stack_.end() - site.slots, site.slots);
  const uint64_t hash = hash_of(module, arguments);
  if (earlier_calls_) {
    const auto position = earlier_calls_->find(
        hash, [&](const KeptCall& call) { return is_same_call(call, module, arguments); });
    if (position && reuse_call(*position)) {
      stack_.drop_to(stack_.size() - site.slots);
      module_names_.pop_back();
      end_node(false);
      return true;
    }
  }
  Record& record = begin_record(kNoUnit);
  record.hash = hash;
  --record.modules;  // which counts itself already
  record.frames = frames_.size() + 1;
  record.first_node = tree_.size();
  record.first_call = static_cast<uint32_t>(calls_.calls.size());
  return false;
}

bool Machine::is_same_call(const KeptCall& call, const ModuleEntry& module,
                           std::span<const Value> arguments) {
  if (call.module != number_of(module) || frames_.size() > call.depth) return false;
  auto kept = call.arguments.begin();
  for (size_t slot = 0; slot < arguments.size(); ++slot) {
    if (!arguments[slot].is_set()) continue;
    if (kept == call.arguments.end() || kept->first != module.parameters.slot_names[slot] ||
        !are_identical(kept->second, arguments[slot]))
      return false;
    ++kept;
  }
  if (kept != call.arguments.end()) return false;
  for (const uint32_t number : call.definitions)
    if (!earlier_calls_->is_same_definition(number)) return false;
  for (const uint32_t slot : call.variables)
    if (!earlier_calls_->is_same_variable(slot, main_scope_->values()[slot])) return false;
  for (const auto& [name, value] : call.reads)
    if (!are_identical(dynamic_[name], value)) return false;
  return true;
}

bool Machine::reuse_call(size_t position) {
  const KeptCalls& earlier = earlier_calls_->kept();
  const KeptNodes& nodes = earlier.calls[position];
  const KeptCall& call = *nodes.call;
  for (const uint32_t slot : call.variables)
    if (!keep_variable(slot)) return false;
  const uint32_t shift = tree_.size() - nodes.first;
  const auto moved = [&](Place place) { return earlier_calls_->moved(place, call.definitions); };
  if (!tree_.append(*earlier.tree, nodes.first, nodes.end, moved)) return false;
  for (size_t i = position - nodes.within; i <= position; ++i) {
    const KeptNodes& kept = earlier.calls[i];
    calls_.calls.push_back({kept.call, kept.first + shift, kept.end + shift, kept.within});
  }
  counted_ += call.work;
  if (!records_.empty()) note_kept(call);
  return true;
}

void Machine::note_kept(const KeptCall& call) {
  for (const uint32_t number : call.definitions) dependencies_.note(number);
  for (const uint32_t slot : call.variables) dependencies_.note(variable_number(slot));
  for (const auto& read : call.reads) note_read(read.first);
}

// Ends the call that the innermost record is of. Its `$` names are no longer bound, its frame is
// there.
void Machine::end_kept_call() {
  const Record& record = records_.back();
  const bool is_pure =
      record.is_pure && has_said_nothing(record) && record.finds == modules_.files.finds();
  if (is_pure && work() - record.work >= kLeastWork) {
    try {
      keep_call(record);
    } catch (const OutOfValueMemory&) {
      // The evaluation may have enough, if nothing is kept.
    }
  }
  end_record();
}

// Keeps a call, unless something that it depends on cannot be kept.
void Machine::keep_call(const Record& record) {
  const ModuleEntry& module = *activations_.back().module;
  auto call = std::make_shared<KeptCall>();
  call->hash = record.hash;
  call->module = number_of(module);
  call->work = work() - record.work;
  call->depth = record.frames - 1;
  bool is_whole = true;
  // Copying takes no more time than the evaluation has taken.
  ValueCopier copier(64 + 16 * static_cast<size_t>(call->work));
  for (uint32_t slot = 0; slot < frames_.back().code->slots; ++slot) {
    const Value& argument = stack_[base_ + slot];
    if (!argument.is_set()) continue;
    const Name name = module.parameters.slot_names[slot];
    is_whole = is_whole && add_copy(call->arguments, name, argument, copier);
  }
  for (const auto& [name, value] : noted_reads(record))
    is_whole = is_whole && add_copy(call->reads, name, value, copier);
  dependencies_.for_each([&](uint32_t number) {
    if (number < definitions_) {
      call->definitions.push_back(number);
    } else if (number < read_number(0)) {
      call->variables.push_back(number - definitions_);
      is_whole = is_whole && keep_variable(call->variables.back());
    }
  });
  if (!is_whole) return;
  const auto within = static_cast<uint32_t>(calls_.calls.size()) - record.first_call;
  calls_.calls.push_back({std::move(call), record.first_node, tree_.size(), within});
}

// Keeps the value of a variable of the main unit's top level for later comparisons. Returns whether
// it can be kept.
bool Machine::keep_variable(uint32_t slot) {
  const Value& value = main_scope_->values()[slot];
  const auto [kept, is_new] = calls_.variables.try_emplace(slot, Value::unset());
  if (is_new) {
    const bool is_known = earlier_calls_ && earlier_calls_->is_same_variable(slot, value);
    kept->second =
        is_known ? earlier_calls_->kept().variables.at(slot) : ValueCopier(kMostKept).copy(value);
  }
  return kept->second.is_set() || !value.is_set();
}

}  // namespace language
