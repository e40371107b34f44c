// Gathers what stands in a scope.
#pragma once

#include <optional>
#include <vector>

#include "base/name_list.hpp"
#include "syntax/arena.hpp"
#include "syntax/arena_list.hpp"
#include "syntax/kept_sources.hpp"
#include "syntax/syntax.hpp"

namespace language {

/// An ArenaList whose elements have names, each once.
template <typename T>
class NamedArenaList : public ArenaList<T> {
 public:
  using ArenaList<T>::ArenaList;

  /// Returns the element of a name, or null.
  T* find(Name name) {
    const uint32_t position =
        index_.find(name, this->size(), [this](uint32_t i) { return (*this)[i].name; });
    return position == NameIndex::kNone ? nullptr : &(*this)[position];
  }

 private:
  NameIndex index_;
};

/// What the scopes being parsed share.
struct ScopeStacks {
  std::vector<Assignment> assignments;
  std::vector<FunctionDefinition> functions;
  std::vector<ModuleDefinition> modules;
  std::vector<ModuleCall> calls;
};

/// One scope being parsed; those within it must be finished before.
class ScopeBuilder {
 public:
  /// `record`, if it is not null, gets all that is added, in order.
  explicit ScopeBuilder(ScopeStacks& stacks, std::vector<TopLevelItem>* record = nullptr)
      : assignments_(stacks.assignments),
        functions_(stacks.functions),
        modules_(stacks.modules),
        calls_(stacks.calls),
        record_(record) {}

  bool is_recorded() const { return record_; }

  /// Adds an assignment. One that it overwrites keeps its position in the list. Returns it, or
  /// null.
  std::optional<Assignment> add(const Assignment& assignment) {
    note(assignment);
    Assignment* older = assignments_.find(assignment.name);
    if (!older) {
      assignments_.push(assignment);
      return std::nullopt;
    }
    if (older->first.file == kNoFile) older->first = older->place;
    const Assignment overwritten = *older;
    older->value = assignment.value;
    older->place = assignment.place;
    return overwritten;
  }
  void add(const FunctionDefinition& definition) { replace(functions_, definition); }
  void add(const ModuleDefinition& definition) { replace(modules_, definition); }
  void add(const ModuleCall& call) {
    note(call);
    calls_.push(call);
  }
  /// Returns the scope, in an arena.
  const Scope* finish(Arena& arena) const {
    auto* scope = new (arena.allocate(sizeof(Scope), alignof(Scope))) Scope;
    scope->assignments = assignments_.finish(arena);
    scope->functions = functions_.finish(arena);
    scope->modules = modules_.finish(arena);
    scope->calls = calls_.finish(arena);
    return scope;
  }

 private:
  void note(const TopLevelItem& item) {
    if (record_) record_->push_back(item);
  }
  template <typename T>
  void replace(NamedArenaList<T>& definitions, const T& definition) {
    note(definition);
    if (T* older = definitions.find(definition.name)) {
      *older = definition;
    } else {
      definitions.push(definition);
    }
  }

  NamedArenaList<Assignment> assignments_;
  NamedArenaList<FunctionDefinition> functions_;
  NamedArenaList<ModuleDefinition> modules_;
  ArenaList<ModuleCall> calls_;
  std::vector<TopLevelItem>* record_;
};

}  // namespace language
