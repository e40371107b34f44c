#include "evaluation/heap_scope.hpp"

#include <memory>
#include <new>

#include "syntax/syntax.hpp"
#include "values/object_memory.hpp"

namespace language {

namespace {

size_t block_size(uint32_t size) { return sizeof(HeapScope) + size * sizeof(Value); }

}  // namespace

HeapScope* HeapScopes::make(HeapScope* parent, uint32_t size) {
  void* block = allocate_object(block_size(size));
  auto* scope = new (block) HeapScope{1, size, parent, this, nullptr, first_};
  if (first_) first_->previous = scope;
  first_ = scope;
  for (uint32_t slot = 0; slot < size; ++slot) new (&scope->values()[slot]) Value(Value::unset());
  return scope;
}

void HeapScopes::destroy(HeapScope* scope) noexcept {
  while (scope && scope->references == 0) {
    HeapScope* const parent = scope->parent;
    (scope->previous ? scope->previous->next : scope->owner->first_) = scope->next;
    if (scope->next) scope->next->previous = scope->previous;
    std::destroy_n(scope->values(), scope->size);
    free_object(scope, block_size(scope->size));
    if (!parent || --parent->references) return;
    scope = parent;
  }
}

void HeapScopes::clear() noexcept {
  for (HeapScope* scope = first_; scope; scope = scope->next) ++scope->references;
  for (HeapScope* scope = first_; scope; scope = scope->next)
    for (uint32_t slot = 0; slot < scope->size; ++slot) scope->values()[slot] = Value::unset();
  while (first_) {
    HeapScope* const scope = first_;
    first_ = scope->next;
    if (first_) first_->previous = nullptr;
    scope->previous = scope->next = nullptr;
    std::destroy_n(scope->values(), scope->size);
    free_object(scope, block_size(scope->size));
  }
}

void Closure::append_text(std::string& out) const {
  append_expression_text(out, *function.literal, names);
}

void leave_scope(HeapScope* scope) noexcept {
  uint32_t own = 1;
  for (uint32_t slot = 0; slot < scope->size; ++slot) {
    const Value& value = scope->values()[slot];
    if (value.is_function() && value.is_unique() && closure_of(value).scope == scope) ++own;
  }
  if (own > 1 && own == scope->references)
    for (uint32_t slot = 0; slot < scope->size; ++slot) scope->values()[slot] = Value::unset();
  HeapScopes::release(scope);
}

}  // namespace language
