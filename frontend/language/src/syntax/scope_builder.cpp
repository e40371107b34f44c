#include "syntax/scope_builder.hpp"

#include <utility>

namespace language {

Place ScopeBuilder::add(const Assignment& assignment) {
  note(assignment);
  Assignment* older = assignments_.find(assignment.name);
  if (!older) {
    assignments_.push(assignment);
    return {};
  }
  older->value = assignment.value;
  return std::exchange(older->place, assignment.place);
}

const Scope* ScopeBuilder::finish(Arena& arena) const {
  auto* scope = new (arena.allocate(sizeof(Scope), alignof(Scope))) Scope;
  scope->assignments = assignments_.finish(arena);
  scope->functions = functions_.finish(arena);
  scope->modules = modules_.finish(arena);
  scope->calls = calls_.finish(arena);
  return scope;
}

}  // namespace language
