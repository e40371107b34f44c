#include "evaluation/closure.hpp"

#include "syntax/syntax.hpp"

namespace language {

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
