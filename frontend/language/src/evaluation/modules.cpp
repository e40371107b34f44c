// Nodes, and the calls of modules.
#include "evaluation/machine.hpp"

namespace language {

void Machine::begin_node(NodeKind kind, uint8_t modifiers) {
  open_nodes_.push_back(tree_.open(kind, modifiers, place()));
}

void Machine::end_node(bool drop_if_empty) {
  const uint32_t node = open_nodes_.back();
  open_nodes_.pop_back();
  tree_.close(node);
  if (drop_if_empty && tree_.nodes[node].end == node + 1) tree_.remove(node);
}

BuiltinCall Machine::builtin_call(const NodeSite& site, bool has_first) {
  const uint32_t above = has_first ? 1 : 0;
  const std::span<const Value> parameters(stack_.end() - above - site.parameters, site.parameters);
  return {parameters,
          has_first ? stack_.top() : Value::unset(),
          dynamic_value(fragments_number_),
          dynamic_value(fragments_angle_),
          dynamic_value(fragments_size_),
          place(),
          modules_};
}

bool Machine::wants_first(const NodeSite& site) {
  return builtin_modules_[site.module].wants_first(builtin_call(site, false));
}

Value Machine::dynamic_value(Name name) {
  if (!records_.empty()) note_read(name);
  const Value& value = dynamic_[name];
  return value.is_set() ? value : Value::undef();
}

void Machine::make_node(const NodeSite& site, uint32_t no_children, bool takes_children) {
  count_step();
  begin_node(NodeKind::kGroup, site.modifiers);
  const Made made = builtin_modules_[site.module].make(builtin_call(site, true), tree_);
  stack_.drop_to(stack_.size() - site.parameters - 1);
  if (made == Made::kNode && takes_children) return;
  next_ = no_children;
  end_node(false);
  if (made == Made::kNothing) tree_.remove(tree_.size() - 1);
}

void Machine::refuse_children(const NodeSite& site) {
  warn("module " + std::string(site.call_name) + "() does not support child modules",
       PathBase::kMainFile);
}

void Machine::say_successor(const NodeSite& site) {
  messages_.say(MessageGroup::kDeprecated,
                "The " + std::string(site.call_name) +
                    "() module will be removed in future releases. Use " +
                    std::string(site.successor) + " instead.",
                place(), PathBase::kMainFile);
}

void Machine::unknown_module(Name name) {
  warn("Ignoring unknown module '" + std::string(compiler_.names().text(name)) + "'",
       PathBase::kMainFile);
}

void Machine::name_module(Name name) {
  module_names_.push_back(compiler_.names().text(name));
  if (parent_modules_ != kNoName)
    dynamic_.bind(parent_modules_, static_cast<double>(module_names_.size()));
}

void Machine::call_module(const CallSite& site) {
  ModuleEntry& module = *site.module;
  if (nests_too_deeply()) {
    fail("Recursion detected calling module '" + std::string(compiler_.names().text(module.name)) +
             "'",
         module.place);
  }
  HeapScope* block_scope = nullptr;
  if (site.block) {
    block_scope = block_scopes_.back();
    block_scopes_.pop_back();
  }
  HeapScope* const scope = take_scope(site);
  begin_node(NodeKind::kGroup, site.modifiers);
  tree_.nodes[open_nodes_.back()].is_module_call = true;
  if (keeps_calls_ && is_kept(site, scope) && begin_kept_call(site)) {
    HeapScopes::release(scope);
    return;
  }
  activations_.push_back({&module, site.block, block_scope, frames_.back().activation});
  const Code& code = compiler_.code_of(module);
  const uint32_t base = stack_.size() - site.slots;
  push_frame(code, base, scope, FrameKind::kModule, static_cast<uint32_t>(activations_.size() - 1));
  for (uint32_t slot = site.slots; slot < code.slots; ++slot) stack_.push(Value::unset());
}

void Machine::return_module() {
  dynamic_.undo(frames_.back().trail);
  if (!records_.empty() && records_.back().frames == frames_.size()) end_kept_call();
  stack_.drop_to(base_);
  HeapScopes::release(activations_.back().block_scope);
  activations_.pop_back();
  module_names_.pop_back();
  pop_frame();
  end_node(false);
}

void Machine::parameter_literal(Name parameter, Name module) {
  const Value value = stack_.pop();
  if (!value.is_set()) return;
  warn("Module " + std::string(compiler_.names().text(module)) + ": Parameter " +
           std::string(compiler_.names().text(parameter)) + " is overwritten with a literal",
       PathBase::kUnit);
}

}  // namespace language
