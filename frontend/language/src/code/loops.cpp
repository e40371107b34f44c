// for, intersection_for, let and assign as modules.
#include "code/code_compiler.hpp"

namespace language {

/// Runs the rounds in the node or list that has been begun, and ends it.
void CodeCompiler::for_statement(const ModuleCall& call) {
  if (!call.arguments.empty()) {
    ScopeLayout& scope = open_scope(true, call.place);
    const uint32_t open = out_.here() - 1;
    for_rounds(call.arguments, call);
    set_scope_size(open, scope);
    close_scope(call.place);
  }
  end_node(call);
}

void CodeCompiler::for_rounds(std::span<const Argument> sources, const ModuleCall& call) {
  if (sources.empty()) return block(*call.children);
  const Argument& source = sources.front();
  const bool has_name = source.name != kNoName;
  const bool is_dynamic = has_name && is_dynamic_name(source.name, compiler_.names());
  const uint32_t base = out_.depth();
  if (is_dynamic) out_.emit(Op::kMarkTrail, source.place, 1);
  expression(*source.value);
  const uint32_t state = out_.depth() - 1;
  out_.emit(Op::kBeginLoop, call.place, 2, 0, 0, kStatementLoop);
  const uint32_t next = out_.emit(Op::kNextRound, call.place, 1, 0, state);
  if (is_dynamic) {
    out_.emit(Op::kUndoTrail, source.place, 0, base);
    out_.emit(Op::kBindDynamic, source.place, -1, source.name);
  } else if (has_name) {
    scope_->declare(source.name);
    store(source.name, source.place);
  } else {
    out_.emit(Op::kPop, source.place, -1);
  }
  for_rounds(sources.subspan(1), call);
  out_.emit(Op::kJump, call.place, 0, next);
  out_.land(next);
  if (is_dynamic) out_.emit(Op::kUndoTrail, source.place, 0, base);
  drop_to(base, source.place);
}

void CodeCompiler::let_statement(const ModuleCall& call) {
  const uint32_t base = out_.depth();
  out_.emit(Op::kMarkTrail, call.place, 1);
  open_scope(true, call.place);
  let_arguments(call.arguments, true);
  group_or_list(call);
  close_scope(call.place);
  out_.emit(Op::kUndoTrail, call.place, 0, base);
  drop_to(base, call.place);
}

// All values that have a name are evaluated outside of the new scope; of a name's values the last
// one counts.
void CodeCompiler::assign_statement(const ModuleCall& call) {
  const uint32_t base = out_.depth();
  out_.code().node_sites[add_node_site(call, NodeKind::kGroup)].successor = "a regular assignment";
  out_.emit(Op::kSuccessor, call.place, 0,
            static_cast<uint32_t>(out_.code().node_sites.size() - 1));
  out_.emit(Op::kMarkTrail, call.place, 1);
  for (const Argument& argument : call.arguments)
    if (argument.name != kNoName) expression(*argument.value);
  ScopeLayout& scope = open_scope(true, call.place);
  const uint32_t open = out_.here() - 1;
  NameList done;
  for (auto argument = call.arguments.rbegin(); argument != call.arguments.rend(); ++argument) {
    if (argument->name == kNoName) continue;
    if (done.find(argument->name) != NameList::kNone) {
      out_.emit(Op::kPop, argument->place, -1);
      continue;
    }
    done.add(argument->name);
    if (!is_dynamic_name(argument->name, compiler_.names())) scope.declare(argument->name);
    store(argument->name, argument->place);
  }
  set_scope_size(open, scope);
  group_or_list(call);
  close_scope(call.place);
  out_.emit(Op::kUndoTrail, call.place, 0, base);
  drop_to(base, call.place);
}

}  // namespace language
