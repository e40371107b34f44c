#include "evaluation/kept_calls.hpp"

#include <string_view>

#include "values/copies.hpp"

namespace language {
namespace {

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

}  // namespace

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

}  // namespace language
