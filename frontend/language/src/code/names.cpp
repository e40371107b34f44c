// Variables: where a name is looked up.
#include <algorithm>
#include <numbers>

#include "code/code_compiler.hpp"

namespace language {
namespace {

/// Returns whether code finds a variable set for certain.
bool is_surely_set(const ScopeVariable& variable, bool is_own, bool finds_all_set) {
  if (variable.is_optional) return false;
  return is_own || finds_all_set || variable.is_always_set;
}

}  // namespace

void CodeCompiler::variable(Name name, Place place) {
  if (is_dynamic_name(name, compiler_.names())) {
    out_.emit(Op::kDynamic, place, 1, name);
  } else {
    variable_or(name, place, Op::kUnknownVariable);
  }
}

void CodeCompiler::variable_or(Name name, Place place, Op otherwise) {
  std::vector<uint32_t> tries;
  bool is_found = false;
  for (const ScopeLayout* scope = scope_; scope && !is_found; scope = scope->parent) {
    const ScopeVariable* found = scope->find(name);
    if (!found) continue;
    const bool is_own = scope->code == &out_.code();
    if (is_own && !found->is_set && !found->is_optional) continue;
    is_found = is_surely_set(*found, is_own, finds_all_set_);
    const Op op = scope->is_in_heap ? (is_found ? Op::kScoped : Op::kTryScoped)
                                    : (is_found ? Op::kLocal : Op::kTryLocal);
    const uint32_t number = scope->is_in_heap ? scope_number(*scope) : 0;
    const uint32_t position = out_.emit(op, place, is_found ? 1 : 0, found->slot, number);
    if (!is_found) tries.push_back(position);
  }
  if (!is_found) {
    if (name == compiler_.known().pi) {
      out_.constant(std::numbers::pi, place);
    } else {
      out_.emit(otherwise, place, 1, name);
    }
  }
  for (const uint32_t position : tries)
    out_.at(position).flag = static_cast<uint16_t>(out_.here() - position - 1);
}

/// Pushes what a name that is called means among the variables: undef if they hold no function. In
/// 2026 one that holds none hides no other further out.
void CodeCompiler::callee_variable(Name name, Place place) {
  std::vector<const ScopeLayout*> scopes;
  for (const ScopeLayout* scope = scope_; scope; scope = scope->parent) {
    const ScopeVariable* const found = scope->find(name);
    const bool is_own = scope->code == &out_.code();
    if (found && (!is_own || found->is_set || found->is_optional)) scopes.push_back(scope);
  }
  if (scopes.size() < 2 || !compiler_.dialect().finds_outer_functions)
    return variable_or(name, place, Op::kUndef);
  std::vector<uint32_t> functions;
  for (const ScopeLayout* const scope : scopes) {
    const uint32_t number = scope->is_in_heap ? scope_number(*scope) : 0;
    const Op op = scope->is_in_heap ? Op::kTryScoped : Op::kTryLocal;
    out_.emit(op, place, 0, scope->find(name)->slot, number, 1);
    const uint32_t unset = out_.emit(Op::kJump, place, 1);
    functions.push_back(out_.emit(Op::kIfFunction, place, 0));
    out_.emit(Op::kPop, place, -1);
    out_.land(unset);
  }
  out_.emit(Op::kUndef, place, 1);
  for (const uint32_t position : functions) out_.land(position);
}

/// Returns whether reading a variable finds it in the frame for certain.
bool CodeCompiler::is_known_variable(Name name) const {
  if (is_dynamic_name(name, compiler_.names())) return false;
  for (const ScopeLayout* scope = scope_; scope; scope = scope->parent) {
    const ScopeVariable* const found = scope->find(name);
    if (!found) continue;
    const bool is_own = scope->code == &out_.code();
    if (is_own && !found->is_set && !found->is_optional) continue;
    return is_surely_set(*found, is_own, finds_all_set_);
  }
  return false;
}

bool CodeCompiler::may_be_variable(Name name) const {
  if (is_dynamic_name(name, compiler_.names())) return false;
  for (const ScopeLayout* scope = scope_; scope; scope = scope->parent) {
    const ScopeVariable* found = scope->find(name);
    if (!found) continue;
    if (scope->code != &out_.code() || found->is_set || found->is_optional) return true;
  }
  return false;
}

void CodeCompiler::store(Name name, Place place) {
  if (is_dynamic_name(name, compiler_.names())) {
    out_.emit(Op::kBindDynamic, place, -1, name);
    return;
  }
  ScopeVariable* variable = scope_->find(name);
  variable->is_set = true;
  if (scope_->is_in_heap) {
    out_.emit(Op::kStoreScoped, place, -1, variable->slot, 0);
  } else {
    out_.emit(Op::kStoreLocal, place, -1, variable->slot);
  }
}

ScopeLayout& CodeCompiler::open_scope(bool is_in_heap, Place place) {
  scope_ = &compiler_.add_scope(scope_, scope_->unit, &out_.code(), is_in_heap);
  if (is_in_heap) out_.emit(Op::kPushScope, place, 0);
  return *scope_;
}

void CodeCompiler::set_scope_size(uint32_t position, const ScopeLayout& scope) {
  out_.at(position).b = scope.size();
}

void CodeCompiler::close_scope(Place place) {
  if (scope_->is_in_heap) out_.emit(Op::kPopScope, place, 0);
  scope_ = const_cast<ScopeLayout*>(scope_->parent);
}

}  // namespace language
