#include "evaluation/heap_scope.hpp"

#include <memory>
#include <new>

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

}  // namespace language
