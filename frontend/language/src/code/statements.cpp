// Assignments and module calls.
#include <algorithm>

#include "code/code_compiler.hpp"
#include "code/expression_facts.hpp"

namespace language {

bool CodeCompiler::compile_unit(const Scope& scope) {
  for (const Assignment& assignment : scope.assignments)
    if (!is_dynamic_name(assignment.name, compiler_.names())) scope_->declare(assignment.name);
  const bool has_dynamic = assigns_dynamic(scope);
  const bool forgets =
      has_dynamic && scope_->unit != 0 && compiler_.dialect().forgets_names_of_units;
  const uint32_t mark = out_.depth();
  if (forgets) out_.emit(Op::kMarkTrail, {}, 1);
  assign(scope, nullptr, {});
  if (forgets) {
    out_.emit(Op::kUndoTrail, {}, 0, mark);
    out_.emit(Op::kPop, {}, -1);
  }
  out_.emit(Op::kEndUnit, {}, 0);
  return has_dynamic && !forgets;
}

void CodeCompiler::compile_block(BlockEntry& block) {
  finds_all_set_ = true;
  auto& entries = out_.code().entries;
  out_.set_depth(block.slots);
  if (block.assigned) {
    const Place place = block.assigned->assignments.front().place;
    ScopeLayout& layout = open_scope(true, place);
    const uint32_t open = out_.here() - 1;
    for (const Assignment& assignment : block.assigned->assignments)
      if (!is_dynamic_name(assignment.name, compiler_.names())) layout.declare(assignment.name);
    set_scope_size(open, layout);
    assign(*block.assigned, nullptr, {});
  }
  if (block.slots > 0) out_.emit(Op::kEndChild, {}, 0);  // goes to the first that is selected
  for (const ModuleCall& call : block.calls) {
    entries.push_back(out_.here());
    statement(call);
    out_.emit(Op::kEndChild, call.place, 0);
  }
  entries.push_back(out_.here());
  out_.emit(Op::kEndChild, {}, 0, 0, 0, 1);
}

// Parameters, $children and the variables of the body are one scope.
void CodeCompiler::compile_module(ModuleEntry& module) {
  finds_all_set_ = true;
  const auto& parameters = module.parameters;
  const auto slots = static_cast<uint32_t>(parameters.slot_names.size());
  out_.code().slots = slots;
  out_.set_depth(slots);
  defaults_of_callee(module);
  if (compiler_.counts_modules() && compiler_.dialect().has_arguments_first)
    out_.emit(Op::kCountModules, module.place, 0);
  ScopeLayout& scope = open_scope(true, module.place);
  const uint32_t open = out_.here() - 1;
  out_.emit(Op::kChildCount, module.place, 1);
  scope.declare(compiler_.known().child_count);
  store(compiler_.known().child_count, module.place);
  for (uint32_t slot = 0; slot < slots; ++slot) {
    const bool is_declared = slot < parameters.declared_slots;
    ScopeVariable& variable = scope.declare(parameters.slot_names[slot]);
    const bool overrides_count = variable.name == compiler_.known().child_count && !is_declared;
    const uint32_t target = variable.slot;
    variable.is_set = variable.is_always_set = is_declared || overrides_count;
    variable.is_optional = !variable.is_set;
    out_.emit(Op::kLocal, module.place, 1, slot);
    out_.emit(Op::kStoreScoped, module.place, -1, target, 0, overrides_count ? 1 : 0);
  }
  for (const Assignment& assignment : module.body->assignments)
    if (!is_dynamic_name(assignment.name, compiler_.names())) scope.declare(assignment.name);
  compiler_.define(scope, *module.body);
  set_scope_size(open, scope);
  bind_parameters(module);
  assign(*module.body, &module, {});
  out_.code().statements = out_.here();
  statements(module.body->calls);
  out_.emit(Op::kReturnModule, module.place, 0);
}

bool CodeCompiler::assigns_dynamic(const Scope& scope) const {
  return std::any_of(scope.assignments.begin(), scope.assignments.end(),
                     [&](const Assignment& assignment) {
                       return is_dynamic_name(assignment.name, compiler_.names());
                     });
}

bool Hiding::hides(Name name) const {
  const auto has_name = [&](const auto& binding) { return binding.name == name; };
  return std::any_of(arguments.begin(), arguments.end(), has_name) ||
         (unit && std::any_of(unit->assignments.begin(), unit->assignments.end(), has_name));
}

void CodeCompiler::assign(const Scope& scope, const ModuleEntry* module, const Hiding& hiding) {
  for (const Assignment& assignment : scope.assignments) {
    if (module) parameter_warning(assignment, *module);
    const uint32_t region = begin_region();
    expression(*assignment.value);
    if (compiler_.dialect().has_full_traces)
      out_.code().regions.push_back({region, out_.here(), compiler_.names().text(assignment.name),
                                     nullptr, assignment.place, true, false, assignment.first});
    const bool is_hidden =
        is_dynamic_name(assignment.name, compiler_.names()) && hiding.hides(assignment.name);
    if (is_hidden) {
      out_.emit(Op::kPop, assignment.place, -1);
    } else {
      store(assignment.name, assignment.place);
      ScopeVariable* const variable = scope_->find(assignment.name);
      if (!variable) continue;  // a `$` name
      variable->is_optional = false;
      if (!module || !compiler_.dialect().has_full_traces) continue;
      const uint32_t slot = module->parameters.slot_names.find(assignment.name);
      if (slot >= module->parameters.declared_slots) continue;
      out_.emit(Op::kScoped, assignment.place, 1, variable->slot, 0);
      out_.emit(Op::kStoreLocal, assignment.place, -1, slot);  // which traces of the call show
    }
  }
}

void CodeCompiler::parameter_warning(const Assignment& assignment, const ModuleEntry& module) {
  if (!is_literal(*assignment.value)) return;
  const ScopeVariable* variable = scope_->find(assignment.name);
  if (!variable) return;  // a `$` name
  const bool is_parameter = module.parameters.declares(assignment.name) || variable->is_optional ||
                            assignment.name == compiler_.known().child_count;
  if (!is_parameter) return;
  out_.emit(Op::kScoped, assignment.place, 1, variable->slot, 0);
  out_.emit(Op::kParameterLiteral, assignment.place, -1, assignment.name, module.name);
}

void CodeCompiler::statements(std::span<const ModuleCall> calls) {
  for (const ModuleCall& call : calls) statement(call);
}

void CodeCompiler::block(const Scope& scope) {
  if (scope.assignments.empty()) return statements(scope.calls);
  const Place place = scope.assignments.front().place;
  const bool has_mark = assigns_dynamic(scope);
  const uint32_t base = out_.depth();
  if (has_mark) out_.emit(Op::kMarkTrail, place, 1);
  ScopeLayout& layout = open_scope(true, place);
  const uint32_t open = out_.here() - 1;
  for (const Assignment& assignment : scope.assignments)
    if (!is_dynamic_name(assignment.name, compiler_.names())) layout.declare(assignment.name);
  set_scope_size(open, layout);
  assign(scope, nullptr, {});
  statements(scope.calls);
  close_scope(place);
  if (has_mark) out_.emit(Op::kUndoTrail, place, 0, base);
  drop_to(base, place);
}

void CodeCompiler::statement(const ModuleCall& call) {
  if (call.name == kNoName) return if_statement(call);
  const auto found = compiler_.find_module(*scope_, call.name);
  const auto& builtins = compiler_.builtins().modules;
  const uint32_t region = begin_region();
  if (found.entry) {
    module_call(call, found);
  } else if (const auto builtin = builtins.find(call.name); builtin != builtins.end()) {
    builtin_module(call, builtin->second);
  } else if (!special_statement(call)) {
    out_.emit(Op::kUnknownModule, call.place, 0, call.name);
  }
  end_region(region, call.name, nullptr, call.place);
}

bool CodeCompiler::special_statement(const ModuleCall& call) {
  const Compiler::KnownNames& known = compiler_.known();
  const Name name = call.name;
  if (name == known.for_) {
    begin_list(call);
    for_statement(call);
  } else if (name == known.intersection_for) {
    begin_node(call, NodeKind::kIntersection);
    for_statement(call);
  } else if (name == known.let) {
    let_statement(call);
  } else if (name == known.assign) {
    assign_statement(call);
  } else if (name == known.children || name == known.child) {
    children_call(call, name == known.child);
  } else if (name == known.echo) {
    echo_arguments(call.arguments, call.place);
    node_if_children(call);
  } else if (name == known.assert_) {
    assert_arguments(call.arguments, call.place);
    node_if_children(call);
  } else if (name == known.group || name == known.union_ || name == known.difference ||
             name == known.intersection) {
    operation_node(call, name == known.union_         ? NodeKind::kUnion
                         : name == known.difference   ? NodeKind::kDifference
                         : name == known.intersection ? NodeKind::kIntersection
                                                      : NodeKind::kGroup);
  } else {
    return false;
  }
  return true;
}

void CodeCompiler::if_statement(const ModuleCall& call) {
  const uint32_t region = begin_region();
  const uint32_t is_false = jump_if_false(*call.condition);
  group_or_list(call);
  if (call.else_children) {
    const uint32_t done = out_.emit(Op::kJump, call.place, 0);
    out_.land(is_false);
    begin_list(call);
    block(*call.else_children);
    end_node(call);
    out_.land(done);
  } else {
    out_.land(is_false);
  }
  out_.code().regions.push_back({region, out_.here(), "if", nullptr, call.place});
}

uint32_t CodeCompiler::add_node_site(const ModuleCall& call, NodeKind kind) {
  auto& sites = out_.code().node_sites;
  NodeSite site;
  site.kind = kind;
  site.modifiers = call.modifiers;
  if (call.name != kNoName) site.call_name = compiler_.names().text(call.name);
  sites.push_back(site);
  return static_cast<uint32_t>(sites.size() - 1);
}

/// Adds the site of a group, or of a list in its place.
uint32_t CodeCompiler::add_list_site(const ModuleCall& call) {
  const uint32_t number = add_node_site(call, NodeKind::kGroup);
  out_.code().node_sites[number].is_list = compiler_.has_lazy_union();
  return number;
}

void CodeCompiler::begin_list(const ModuleCall& call) {
  out_.emit(Op::kBeginNode, call.place, 0, add_list_site(call));
}

void CodeCompiler::begin_node(const ModuleCall& call, NodeKind kind) {
  out_.emit(Op::kBeginNode, call.place, 0, add_node_site(call, kind));
}

void CodeCompiler::end_node(const ModuleCall& call, bool drop_if_empty) {
  out_.emit(Op::kEndNode, call.place, 0, 0, 0, drop_if_empty ? 1 : 0);
}

void CodeCompiler::operation_node(const ModuleCall& call, NodeKind kind) {
  const uint32_t start = out_.depth();
  const bool has_mark = names_dynamic(call.arguments, compiler_.names());
  if (has_mark) out_.emit(Op::kMarkTrail, call.place, 1);
  unused_arguments(call);
  plain_node(call, kind);
  if (has_mark) out_.emit(Op::kUndoTrail, call.place, 0, start);
  drop_to(start, call.place);
}

void CodeCompiler::plain_node(const ModuleCall& call, NodeKind kind) {
  begin_node(call, kind);
  block(*call.children);
  end_node(call);
}

void CodeCompiler::group_or_list(const ModuleCall& call) {
  begin_list(call);
  block(*call.children);
  end_node(call);
}

void CodeCompiler::node_if_children(const ModuleCall& call) {
  begin_list(call);
  block(*call.children);
  end_node(call, true);
}

}  // namespace language
