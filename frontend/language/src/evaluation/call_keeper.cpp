#include "evaluation/call_keeper.hpp"

#include <algorithm>
#include <functional>
#include <string_view>

#include "values/copies.hpp"

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

std::string_view text_of(const SourceFiles& files, const DefinitionText& definition) {
  const std::string_view text = files[definition.file].text;
  return text.substr(definition.begin, definition.end - definition.begin);
}

bool is_same(const SourceFiles& before, const DefinitionText& old, const SourceFiles& now,
             const DefinitionText& definition) {
  if (old.file == kNoFile || old.file != definition.file || !before.has(old.file)) return false;
  // Files that have not changed are shared.
  const bool is_same_file = &before[old.file] == &now[old.file];
  if (is_same_file && old.begin == definition.begin) return old.end == definition.end;
  return text_of(before, old) == text_of(now, definition);
}

template <typename Definition>
DefinitionText text_of(const Definition& definition) {
  const DefinitionExtent& extent = definition.extent;
  if (extent.end == 0) return {};
  return {definition.place.file, extent.begin, extent.end};
}

template <typename Named>
void append_names(std::vector<uint64_t>& structure, std::span<const Named> list) {
  structure.push_back(list.size());
  for (const Named& named : list) structure.push_back(named.name);
}

std::vector<DefinitionText> definition_texts(const Program& program) {
  std::vector<DefinitionText> texts;
  const Scope* const scope = program.units[0].scope;
  if (!scope) return texts;
  for (const FunctionDefinition& function : scope->functions) texts.push_back(text_of(function));
  for (const ModuleDefinition& module : scope->modules) texts.push_back(text_of(module));
  return texts;
}

std::vector<uint64_t> program_structure(const Program& program) {
  std::vector<uint64_t> structure;
  const Unit& main = program.units[0];
  structure.push_back(main.file);
  if (!main.scope) return structure;
  append_names(structure, main.scope->assignments);
  append_names(structure, main.scope->functions);
  append_names(structure, main.scope->modules);
  structure.push_back(main.uses.size());
  for (const uint32_t used : main.uses) {
    structure.push_back(program.units[used].file);
    const auto identity = unit_identity(program, used);
    structure.insert(structure.end(), identity.begin(), identity.end());
  }
  return structure;
}

}  // namespace

CallIndex::CallIndex(const KeptCalls& kept, const std::vector<DefinitionText>& now,
                     const SourceFiles& files)
    : kept_(kept), next_(kept.calls.size(), kNone), now_(now) {
  for (size_t position = 0; position < kept.calls.size(); ++position) {
    const auto [found, is_first] =
        heads_.try_emplace(kept.calls[position].call->hash, Head{position, position, position});
    if (is_first) continue;
    next_[found->second.last] = position;
    found->second.last = position;
  }
  is_same_definition_.reserve(now_.size());
  for (size_t i = 0; i < now_.size(); ++i) {
    const DefinitionText& old = kept.definitions[i];
    is_same_definition_.push_back(is_same(*kept.files, old, files, now_[i]));
    has_moved_ = has_moved_ || old.begin != now_[i].begin;
  }
}

bool CallIndex::is_same_variable(uint32_t slot, const Value& value) {
  if (slot >= variables_.size()) variables_.resize(slot + 1, Comparison::kNone);
  Comparison& comparison = variables_[slot];
  if (comparison == Comparison::kNone) {
    const auto found = kept_.variables.find(slot);
    const bool is_same = found != kept_.variables.end() && are_identical(found->second, value);
    comparison = is_same ? Comparison::kSame : Comparison::kOther;
  }
  return comparison == Comparison::kSame;
}

Place CallIndex::moved(Place place, const std::vector<uint32_t>& definitions) const {
  if (!has_moved_) return place;
  for (const uint32_t number : definitions) {
    const DefinitionText& old = kept_.definitions[number];
    if (place.file != old.file || place.offset < old.begin || place.offset >= old.end) continue;
    return {place.file, place.offset - old.begin + now_[number].begin};
  }
  return place;
}

void CallKeeper::use(const KeptCalls& earlier) {
  is_on_ = true;
  calls_.structure = program_structure(program_);
  calls_.definitions = definition_texts(program_);
  if (earlier.tree && earlier.structure == calls_.structure)
    earlier_.emplace(earlier, calls_.definitions, program_.files);
}

// Whether a call may be kept: its code runs no block of another call's, and sees no scopes around
// it but a top level, whose variables are known to depend on nothing but its text if it is a used
// file's.
bool CallKeeper::may_keep(const CallSite& site, const HeapScope* scope) const {
  const ScopeLayout& around = *site.module->scope;
  if (site.block || around.parent) return false;
  return around.unit == 0 || tops_.depends_on_text_alone(around.unit, scope);
}

bool CallKeeper::begin(const CallSite& site, const HeapScope* scope) {
  if (!is_on_ || !may_keep(site, scope)) return false;
  const ModuleEntry& module = *site.module;
  const std::span<const Value> arguments(stack_.values.end() - site.slots, site.slots);
  const uint64_t hash = hash_of(module, arguments);
  if (earlier_) {
    const auto position = earlier_->find(
        hash, [&](const KeptCall& call) { return is_same(call, module, arguments); });
    if (position && reuse(*position)) return true;
  }
  Record& record = stack_.recorder.begin(kNoUnit);
  record.hash = hash;
  --record.modules;  // which counts itself already
  record.frames = stack_.depth() + 1;
  record.first_node = tree_.size();
  record.first_call = static_cast<uint32_t>(calls_.calls.size());
  return false;
}

bool CallKeeper::is_same(const KeptCall& call, const ModuleEntry& module,
                         std::span<const Value> arguments) {
  if (call.module != number_of(module) || stack_.depth() > call.depth) return false;
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
    if (!earlier_->is_same_definition(number)) return false;
  for (const uint32_t slot : call.variables)
    if (!earlier_->is_same_variable(slot, tops_.main_scope()->values()[slot])) return false;
  for (const auto& [name, value] : call.reads)
    if (!are_identical(stack_.dynamic[name], value)) return false;
  return true;
}

bool CallKeeper::reuse(size_t position) {
  const KeptCalls& earlier = earlier_->kept();
  const KeptNodes& nodes = earlier.calls[position];
  const KeptCall& call = *nodes.call;
  for (const uint32_t slot : call.variables)
    if (!keep_variable(slot)) return false;
  const uint32_t shift = tree_.size() - nodes.first;
  const auto moved = [&](Place place) { return earlier_->moved(place, call.definitions); };
  if (!tree_.append(*earlier.tree, nodes.first, nodes.end, moved)) return false;
  for (size_t i = position - nodes.within; i <= position; ++i) {
    const KeptNodes& kept = earlier.calls[i];
    calls_.calls.push_back({kept.call, kept.first + shift, kept.end + shift, kept.within});
  }
  stack_.steps.add(call.work);
  if (stack_.recorder.is_recording()) note(call);
  return true;
}

void CallKeeper::note(const KeptCall& call) {
  for (const uint32_t number : call.definitions) stack_.recorder.note_definition(number);
  for (const uint32_t slot : call.variables) stack_.recorder.note_variable(slot);
  for (const auto& read : call.reads) stack_.recorder.note_read(read.first);
}

void CallKeeper::end(const ModuleEntry& module) {
  if (!stack_.recorder.is_recording()) return;
  const Record& record = stack_.recorder.innermost();
  if (record.frames != stack_.depth()) return;
  if (stack_.recorder.is_repeatable() && stack_.steps.steps() - record.steps >= kLeastWork) {
    try {
      keep(record, module);
    } catch (const OutOfValueMemory&) {
      // The evaluation may have enough, if nothing is kept.
    }
  }
  stack_.recorder.end();
}

// Keeps a call, unless something that it depends on cannot be kept.
void CallKeeper::keep(const Record& record, const ModuleEntry& module) {
  auto call = std::make_shared<KeptCall>();
  call->hash = record.hash;
  call->module = number_of(module);
  call->work = stack_.steps.steps() - record.steps;
  call->depth = record.frames - 1;
  bool is_whole = true;
  // Copying takes no more time than the evaluation has taken.
  ValueCopier copier(64 + 16 * static_cast<size_t>(call->work));
  for (uint32_t slot = 0; slot < stack_.code().slots; ++slot) {
    const Value& argument = stack_.slot(slot);
    if (!argument.is_set()) continue;
    const Name name = module.parameters.slot_names[slot];
    is_whole = is_whole && add_copy(call->arguments, name, argument, copier);
  }
  for (const auto& [name, value] : stack_.recorder.reads())
    is_whole = is_whole && add_copy(call->reads, name, value, copier);
  stack_.recorder.append_sources(call->definitions, call->variables);
  for (const uint32_t slot : call->variables) is_whole = is_whole && keep_variable(slot);
  if (!is_whole) return;
  const auto within = static_cast<uint32_t>(calls_.calls.size()) - record.first_call;
  calls_.calls.push_back({std::move(call), record.first_node, tree_.size(), within});
}

// Keeps the value of a variable of the main unit's top level for later comparisons. Returns whether
// it can be kept.
bool CallKeeper::keep_variable(uint32_t slot) {
  const Value& value = tops_.main_scope()->values()[slot];
  const auto [kept, is_new] = calls_.variables.try_emplace(slot, Value::unset());
  if (is_new) {
    const bool is_known = earlier_ && earlier_->is_same_variable(slot, value);
    kept->second =
        is_known ? earlier_->kept().variables.at(slot) : ValueCopier(kMostKept).copy(value);
  }
  return kept->second.is_set() || !value.is_set();
}

}  // namespace language
