// Calls of user modules, of builtin modules, and children().
#include "code/code_compiler.hpp"

namespace language {

// The assignments of the children's block are evaluated before the call, in a scope that the
// arguments are then evaluated in and the children run in. It is left open.
BlockEntry* CodeCompiler::save_block(const ModuleCall& call, const Hiding& hiding) {
  const Scope& scope = *call.children;
  if (scope.assignments.empty() && scope.calls.empty()) return nullptr;
  if (compiler_.dialect().has_blocks_at_children) {
    const bool has_assignments = !scope.assignments.empty();
    BlockEntry& block =
        compiler_.add_block(scope.calls, *scope_, has_assignments ? &scope : nullptr);
    out_.emit(Op::kSaveBlock, call.place, 0);
    return &block;
  }
  if (!scope.assignments.empty()) {
    ScopeLayout& layout = open_scope(true, call.place);
    const uint32_t open = out_.here() - 1;
    for (const Assignment& assignment : scope.assignments)
      if (!is_dynamic_name(assignment.name, compiler_.names())) layout.declare(assignment.name);
    set_scope_size(open, layout);
    assign(scope, nullptr, hiding);
  }
  BlockEntry& block = compiler_.add_block(scope.calls, *scope_);
  out_.emit(Op::kSaveBlock, call.place, 0);
  return &block;
}

void CodeCompiler::module_call(const ModuleCall& call, Found<ModuleEntry> found) {
  ModuleEntry& module = *found.entry;
  const ArgumentPlan plan = compiler_.plan_module(module, call.arguments, call.place);
  const uint32_t unit = module.scope->unit;
  const uint32_t start = out_.depth();
  const bool has_mark = binds_dynamic(module, plan) || assigns_dynamic(*call.children) ||
                        (found.is_in_other_unit && compiler_.unit(unit).binds_dynamic) ||
                        compiler_.counts_modules();
  if (has_mark) out_.emit(Op::kMarkTrail, call.place, 1);
  CallSite site;
  site.module = &module;
  site.modifiers = call.modifiers;
  if (found.is_in_other_unit) out_.emit(Op::kEnterUnit, call.place, 0, unit);
  const Scope* const used =
      found.is_in_other_unit ? compiler_.program().units[unit].scope : nullptr;
  ScopeLayout* const outer = scope_;
  site.block = save_block(call, {{}, used});
  site.is_in_unit = found.is_in_other_unit;
  site.scope = found.is_in_other_unit ? 0 : scope_number(*module.scope);
  site.slots = static_cast<uint32_t>(module.parameters.slot_names.size());
  auto& calls = out_.code().calls;
  const auto number = static_cast<uint32_t>(calls.size());
  calls.push_back(site);
  out_.emit(Op::kNameModule, call.place, 0, number);
  if (compiler_.counts_modules() && !compiler_.dialect().has_arguments_first)
    out_.emit(Op::kCountModules, call.place, 0);
  const uint32_t base = out_.depth();
  begin_call(module.parameters, call.place, number);
  pass_arguments(plan, call.arguments, base, call.place);
  out_.emit(Op::kCallModule, call.place, -static_cast<int>(site.slots), number);
  if (scope_ != outer) close_scope(call.place);
  if (has_mark) out_.emit(Op::kUndoTrail, call.place, 0, start);
  drop_to(start, call.place);
}

void CodeCompiler::builtin_module(const ModuleCall& call, const ModuleShape& module) {
  const uint32_t start = out_.depth();
  const Scope& children = *call.children;
  const bool has_late_block = compiler_.dialect().has_blocks_at_children;
  const bool has_assignments = module.takes_children && !children.assignments.empty();
  const bool takes_children =
      module.takes_children && (!children.calls.empty() || (has_late_block && has_assignments));
  const bool has_block = has_assignments && !has_late_block;
  const bool has_mark =
      names_dynamic(call.arguments, compiler_.names()) || (has_block && assigns_dynamic(children));
  if (has_mark) out_.emit(Op::kMarkTrail, call.place, 1);
  const uint32_t number = add_node_site(call, NodeKind::kGroup);
  NodeSite& site = out_.code().node_sites[number];
  site.module = module.index;
  site.parameters = static_cast<uint32_t>(module.parameters.size());
  site.successor = module.successor;
  const bool is_refused = !children.calls.empty() || (!children.assignments.empty() &&
                                                      compiler_.dialect().refuses_assignments);
  const bool refuses = module.refuses_children && is_refused;
  if (refuses && !compiler_.dialect().has_arguments_first)
    out_.emit(Op::kRefuseChildren, call.place, 0, number);
  if (!module.successor.empty()) out_.emit(Op::kSuccessor, call.place, 0, number);
  builtin_arguments(call, module, refuses ? std::optional(number) : std::nullopt);
  ScopeLayout* const outer = scope_;
  if (has_block) {
    ScopeLayout& layout = open_scope(true, call.place);
    const uint32_t open = out_.here() - 1;
    for (const Assignment& assignment : children.assignments)
      if (!is_dynamic_name(assignment.name, compiler_.names())) layout.declare(assignment.name);
    set_scope_size(open, layout);
    assign(children, nullptr, {call.arguments, nullptr});
  }
  repeated_argument(call, module, number);  // which sees the block's variables
  const auto popped = static_cast<int>(module.parameters.size()) + 1;
  const uint32_t made =
      out_.emit(Op::kMakeNode, call.place, -popped, 0, number, takes_children ? 1 : 0);
  if (takes_children) {
    if (has_late_block) {
      block(children);
    } else {
      statements(children.calls);
    }
    end_node(call);
  }
  out_.land(made);
  if (scope_ != outer) close_scope(call.place);
  if (has_mark) out_.emit(Op::kUndoTrail, call.place, 0, start);
  drop_to(start, call.place);
}

/// `refused`: the node site of children that are refused, which is said where arguments come first.
void CodeCompiler::builtin_arguments(const ModuleCall& call, const ModuleShape& module,
                                     std::optional<uint32_t> refused) {
  const ArgumentPlan plan =
      compiler_.plan_builtin(module.parameters, module.positional, call.arguments, call.place);
  const bool is_first = compiler_.dialect().has_arguments_first;
  if (!is_first) warn_of_arguments(plan, call.place, false);
  std::vector<std::pair<Name, uint32_t>> late;  // `$` names, and where their values wait
  const auto waits = [&](const ArgumentPlan::Step& step) {
    return is_first && step.target.is_dynamic && !step.is_dropped;
  };
  for (const ArgumentPlan::Step& step : plan.steps) {
    if (!waits(step)) continue;
    late.emplace_back(step.target.name, out_.depth());
    out_.constant(Value::unset(), call.place);
  }
  const uint32_t base = out_.depth();
  const auto count = static_cast<uint32_t>(module.parameters.size());
  for (uint32_t parameter = 0; parameter < count; ++parameter)
    out_.constant(Value::unset(), call.place);
  auto next_late = late.begin();
  for (const ArgumentPlan::Step& step : plan.steps) {
    const Argument& argument = call.arguments[step.argument];
    expression(*argument.value);
    if (waits(step)) {
      out_.emit(Op::kStoreLocal, argument.place, -1, (next_late++)->second);
    } else if (step.target.is_dynamic) {
      out_.emit(Op::kBindDynamic, argument.place, -1, step.target.name);
    } else if (step.is_for(count)) {
      out_.emit(Op::kStoreLocal, argument.place, -1, base + step.target.slot);
    } else {
      out_.emit(Op::kPop, argument.place, -1);
    }
  }
  if (is_first && refused) out_.emit(Op::kRefuseChildren, call.place, 0, *refused);
  if (is_first) warn_of_arguments(plan, call.place, false);
  for (const auto& [name, slot] : late) {
    out_.emit(Op::kLocal, call.place, 1, slot);
    out_.emit(Op::kBindDynamic, call.place, -1, name);
  }
}

/// Evaluates arguments that mean nothing to an operation, where it is a module like others.
void CodeCompiler::unused_arguments(const ModuleCall& call) {
  if (compiler_.dialect().has_plain_children) builtin_arguments(call, ModuleShape{});
}

/// Pushes the first argument, evaluated once more, if the module wants it; else an unset value.
void CodeCompiler::repeated_argument(const ModuleCall& call, const ModuleShape& module,
                                     uint32_t site) {
  const bool may_repeat =
      module.wants_first && !call.arguments.empty() && call.arguments.front().name == kNoName;
  if (!may_repeat) return out_.constant(Value::unset(), call.place);
  const uint32_t unwanted = out_.emit(Op::kWantsFirst, call.place, 0, 0, site);
  expression(*call.arguments.front().value);
  const uint32_t done = out_.emit(Op::kJump, call.place, -1);
  out_.land(unwanted);
  out_.constant(Value::unset(), call.place);
  out_.land(done);
}

void CodeCompiler::children_call(const ModuleCall& call, bool is_child) {
  return compiler_.dialect().has_plain_children ? plain_children_call(call, is_child)
                                                : selection_of_children(call, is_child);
}

void CodeCompiler::plain_children_call(const ModuleCall& call, bool is_child) {
  if (is_child) out_.emit(Op::kDeprecatedChild, call.place, 0);
  const uint32_t site = add_list_site(call);
  const uint32_t start = out_.depth();
  const bool has_mark = names_dynamic(call.arguments, compiler_.names());
  if (has_mark) out_.emit(Op::kMarkTrail, call.place, 1);
  ModuleShape shape{};
  shape.parameters = {compiler_.known().index};
  shape.positional = 1;
  builtin_arguments(call, shape, call.children->calls.empty() ? std::nullopt : std::optional(site));
  const uint32_t none = out_.emit(Op::kRunChildren, call.place, -1, 0, site, is_child ? 1 : 0);
  end_node(call);
  out_.land(none);
  if (has_mark) out_.emit(Op::kUndoTrail, call.place, 0, start);
  drop_to(start, call.place);
}

void CodeCompiler::selection_of_children(const ModuleCall& call, bool is_child) {
  if (is_child) out_.emit(Op::kDeprecatedChild, call.place, 0);
  // child() looks at its argument anywhere, children() within modules only.
  const uint32_t outside = is_child ? 0 : out_.emit(Op::kUnlessInModule, call.place, 0);
  if (call.arguments.empty() && !is_child) {
    out_.emit(Op::kAllChildren, call.place, 0, add_node_site(call, NodeKind::kGroup));
    end_node(call);
    return out_.land(outside);
  }
  if (call.arguments.empty()) {
    out_.constant(0.0, call.place);
  } else {
    expression(*call.arguments.front().value);
  }
  const uint32_t slot = out_.depth() - 1;
  const uint32_t none = out_.emit(Op::kSelectChildren, call.place, 2, 0,
                                  add_node_site(call, NodeKind::kGroup), is_child ? 1 : 0);
  const uint32_t next = out_.emit(Op::kNextChild, call.place, 0, 0, slot);
  out_.emit(Op::kJump, call.place, 0, next);
  out_.land(next);
  out_.emit(Op::kEndSelection, call.place, -3);
  out_.land(none);
  if (!is_child) out_.land(outside);
}

}  // namespace language
