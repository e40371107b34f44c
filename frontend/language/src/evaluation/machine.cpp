#include "evaluation/machine.hpp"

#include <unistd.h>

#include <chrono>
#include <iterator>

#include "code/expression_facts.hpp"
#include "language/make.hpp"

namespace language {
namespace {

// What rands() uses until a call seeds it: another seed at each start.
std::mt19937 seeded_generator() {
  const auto time = std::chrono::system_clock::now().time_since_epoch().count();
  return std::mt19937(static_cast<uint32_t>(time ^ getpid()));
}

// From Op::kPower to Op::kGreaterEqual.
constexpr Value (*kOperators[])(const Value&, const Value&, OperatorProblem&) = {
    operators::power,   operators::multiply,     operators::divide,     operators::modulo,
    operators::add,     operators::subtract,     operators::shift_left, operators::shift_right,
    operators::bit_and, operators::bit_or,       operators::less,       operators::less_equal,
    operators::greater, operators::greater_equal};
constexpr size_t kFirstOperator = static_cast<size_t>(Op::kPower);
static_assert(std::size(kOperators) == static_cast<size_t>(Op::kGreaterEqual) - kFirstOperator + 1);

}  // namespace

Machine::Machine(Compiler& compiler, Messages& messages, ModuleEnvironment& modules, NodeTree& tree,
                 std::stop_token stop)
    : compiler_(compiler),
      environment_{compiler.dialect(), messages, modules.files, seeded_generator(), {}, {}},
      stack_(compiler.program(), environment_, tree, std::move(stop)),
      tops_(compiler, stack_),
      values_(compiler, stack_),
      functions_(compiler, environment_, stack_),
      dynamic_calls_(compiler, stack_, functions_),
      modules_(compiler, modules, environment_.module_names, tree, stack_),
      children_(compiler, stack_, modules_) {}

void Machine::preset(std::string_view name, Value value) {
  stack_.dynamic.bind(compiler_.names().find(name), std::move(value));
}

Value Machine::top_level_value(std::string_view text) const {
  const Name name = compiler_.names().find(text);
  if (name == kNoName) return Value::unset();
  if (!compiler_.names().is_dynamic(name)) {
    const ScopeVariable* const variable = compiler_.unit(0).scope->find(name);
    HeapScope* const scope = tops_.main_scope();
    return variable && scope ? scope->values()[variable->slot] : Value::unset();
  }
  const DynamicNames& dynamic = stack_.dynamic;
  return dynamic.is_bound_since(name, preset_trail_) ? dynamic[name] : Value::unset();
}

ValueType Machine::type_of(const Expression& expression) {
  const Value constant = constant_value(expression);
  if (constant.is_set()) return constant.type();
  FunctionEntry& function = compiler_.add_expression(expression);
  stack_.push(compiler_.code_of(function), stack_.scopes.make(nullptr, 0), FrameKind::kFunction);
  stack_.frame().callee = &function;
  run_guarded();
  return stack_.values.pop().type();
}

void Machine::run_assignments() {
  preset_trail_ = stack_.dynamic.trail();
  tops_.begin_main();
  run_guarded();
  main_trail_ = stack_.dynamic.trail();
}

void Machine::run_calls() {
  const Code& code = compiler_.code_of(compiler_.unit(0).calls);
  stack_.push(code, HeapScopes::acquire(tops_.main_scope()), FrameKind::kBlock);
  run_guarded();
}

void Machine::end_early() {
  if (main_trail_) stack_.dynamic.undo(main_trail_);
}

void Machine::run_guarded() {
  try {
    run();
  } catch (const HardWarning&) {
    stack_.say_traces();
    throw Aborted();
  } catch (const TooLarge& problem) {
    stack_.fail(problem.what(), stack_.place());
  } catch (const OutOfValueMemory&) {
    stack_.fail("The design's values take too much memory", stack_.place());
  } catch (const std::bad_alloc&) {
    stack_.fail("The design takes too much memory", stack_.place());
  }
}

// Each case does what the instruction's comment in code/instruction.hpp says.
bool Machine::execute(const Instruction& step) {
  const Code& code = stack_.code();
  switch (step.op) {
    case Op::kSlide: {
      Value value = stack_.values.pop();
      stack_.values.drop_to(stack_.values.size() - step.b);
      stack_.values.push(std::move(value));
      break;
    }
    case Op::kSwap:
      std::swap(stack_.values.top(), stack_.values.below(1));
      break;
    case Op::kDynamic:
      values_.push_dynamic(step.b, false);
      break;
    case Op::kDynamicSilently:
      values_.push_dynamic(step.b, true);
      break;
    case Op::kUnknownVariable:
      values_.unknown_variable(step.b);
      break;
    case Op::kStoreScoped:
      values_.store_scoped(step);
      break;
    case Op::kBindDynamic:
      stack_.dynamic.bind(step.b, stack_.values.pop());
      break;
    case Op::kMarkTrail:
      stack_.values.push(static_cast<double>(stack_.dynamic.trail()));
      break;
    case Op::kUndoTrail:
      stack_.dynamic.undo(static_cast<uint32_t>(stack_.slot(step.b).number()));
      break;
    case Op::kEndDynamic: {
      Value value = stack_.values.pop();
      stack_.dynamic.undo(static_cast<uint32_t>(stack_.values.pop().number()));
      stack_.values.push(std::move(value));
      break;
    }
    case Op::kPushScope:
      stack_.push_scope(step.b);
      break;
    case Op::kPopScope:
      stack_.pop_scope();
      break;
    case Op::kRenewScope:
      stack_.renew_scope();
      break;
    case Op::kNegate:
      values_.unary(operators::negate);
      break;
    case Op::kComplement:
      values_.unary(operators::complement);
      break;
    case Op::kPower:
    case Op::kMultiply:
    case Op::kDivide:
    case Op::kModulo:
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kShiftLeft:
    case Op::kShiftRight:
    case Op::kBitAnd:
    case Op::kBitOr:
    case Op::kLess:
    case Op::kLessEqual:
    case Op::kGreater:
    case Op::kGreaterEqual:
      values_.binary(kOperators[static_cast<size_t>(step.op) - kFirstOperator]);
      break;
    case Op::kEqual:
    case Op::kNotEqual: {
      const Value left = stack_.values.pop();
      stack_.values.top() =
          Value::boolean(equal(left, stack_.values.top()) == (step.op == Op::kEqual));
      break;
    }
    case Op::kIndex: {
      const Value container = stack_.values.pop();
      stack_.values.top() = element_at(container, stack_.values.top());
      break;
    }
    case Op::kMember:
      stack_.values.top() =
          member(stack_.values.top(), compiler_.names().text(step.b), compiler_.dialect());
      break;
    case Op::kIndexLocal:
      stack_.values.top() = element_at(stack_.slot(step.a), stack_.values.top());
      break;
    case Op::kMemberLocal:
      stack_.values.push(
          member(stack_.slot(step.a), compiler_.names().text(step.b), compiler_.dialect()));
      break;
    case Op::kRange:
      values_.make_range(step.flag);
      break;
    case Op::kVector:
      values_.make_vector(step.b);
      break;
    case Op::kFunction:
      values_.make_closure(step.b);
      break;
    case Op::kAssert:
      values_.assert_top(code.asserts[step.b], step.flag);
      break;
    case Op::kEcho:
      values_.echo(code.echoes[step.b]);
      break;
    case Op::kDuplicateLet:
      values_.duplicate_let(step.b);
      break;
    case Op::kUnnamedLet:
      values_.unnamed_let();
      break;
    case Op::kBeginVector:
      stack_.values.push(make_vector());
      break;
    case Op::kAppend:
      append_element(stack_.slot(step.b), stack_.values.pop());
      break;
    case Op::kAppendEach:
      values_.append_each(step.b);
      break;
    case Op::kAppendEachOfAll:
      values_.append_each_of_all(step.b);
      break;
    case Op::kBeginLoop:
      values_.begin_loop(step.flag);
      break;
    case Op::kReserve:
      make_room(stack_.slot(step.b), static_cast<size_t>(stack_.values.top().number()));
      break;
    case Op::kNextRound:
      if (!values_.next_round(step.a)) stack_.jump(step.b);
      break;
    case Op::kCountRound:
      values_.count_round(step.b);
      break;
    case Op::kEnterUnit:
      tops_.enter(step.b);
      break;
    case Op::kBeginCall:
      functions_.begin(code.calls[step.b]);
      break;
    case Op::kCall:
      functions_.call(code.calls[step.b], step.flag);
      break;
    case Op::kCallBuiltin:
      if (step.flag != 0) stack_.slot(step.flag - 1) = Value::undef();
      functions_.call_builtin(step.b, step.a);
      break;
    case Op::kNextLazy:
      functions_.next_lazy(code.lazy_calls[step.b]);
      break;
    case Op::kKeepLazy:
      functions_.keep_lazy(code.lazy_calls[step.b]);
      break;
    case Op::kWarnCount:
      functions_.warn_count(step.b, step.a);
      break;
    case Op::kUnknownFunction:
      functions_.unknown_function(step.b);
      break;
    case Op::kArgumentWarnings:
      functions_.say_argument_warnings(step.b, step.flag);
      break;
    case Op::kIfFunction:
      if (stack_.values.top().is_function()) stack_.jump(step.b);
      break;
    case Op::kPrepareCall:
      dynamic_calls_.prepare(code.dynamic_calls[step.b]);
      break;
    case Op::kNextArgument:
      dynamic_calls_.next_argument(code.dynamic_calls[step.b]);
      break;
    case Op::kCallDynamic:
      dynamic_calls_.call(code.dynamic_calls[step.b]);
      break;
    case Op::kUnlessCalledAs:
      if (stack_.frame().called_as != step.a) stack_.jump(step.b);
      break;
    case Op::kCachedDefault: {
      stack_.recorder.note_history();
      const Value& cached = code.caches[step.a];
      if (!cached.is_set()) break;
      stack_.values.push_copy(cached);
      stack_.jump(step.b);
      break;
    }
    case Op::kStoreCache:
      code.caches[step.a] = stack_.values.top();
      break;
    case Op::kTailJump:
      functions_.tail_jump(step.a, step.b);
      break;
    case Op::kReturn:
      functions_.return_value();
      return stack_.is_empty();
    case Op::kReturnDefaults:
      functions_.return_defaults();
      break;
    case Op::kUnknownModule:
      modules_.unknown_module(step.b);
      break;
    case Op::kBeginNode:
      modules_.begin_node(code.node_sites[step.b]);
      break;
    case Op::kEndNode:
      modules_.end_node(step.flag);
      break;
    case Op::kSuccessor:
      modules_.say_successor(code.node_sites[step.b]);
      break;
    case Op::kRefuseChildren:
      modules_.refuse_children(code.node_sites[step.b]);
      break;
    case Op::kWantsFirst:
      if (!modules_.wants_first(code.node_sites[step.a])) stack_.jump(step.b);
      break;
    case Op::kMakeNode:
      modules_.make_node(code.node_sites[step.a], step.b, step.flag);
      break;
    case Op::kSaveBlock:
      modules_.save_block();
      break;
    case Op::kNameModule:
      modules_.add_name(code.calls[step.b].module->name);
      break;
    case Op::kCountModules:
      modules_.bind_count();
      break;
    case Op::kCallModule:
      modules_.call(code.calls[step.b]);
      break;
    case Op::kChildCount:
      stack_.values.push(static_cast<double>(children_.count()));
      break;
    case Op::kParameterLiteral:
      modules_.pop_overwritten(step.b, step.a);
      break;
    case Op::kReturnModule:
      modules_.return_from_call();
      break;
    case Op::kUnlessInModule:
      if (!modules_.activation()) stack_.jump(step.b);
      break;
    case Op::kAllChildren:
      children_.run_all(code.node_sites[step.b]);
      break;
    case Op::kDeprecatedChild:
      children_.say_child_is_deprecated();
      break;
    case Op::kSelectChildren:
      if (!children_.select(code.node_sites[step.a], step.flag)) stack_.jump(step.b);
      break;
    case Op::kRunChildren:
      children_.run_selection(code.node_sites[step.a], step.b, step.flag);
      break;
    case Op::kNextChild:
      children_.run_next(step.a, step.b);
      break;
    case Op::kEndSelection:
      children_.end_selection();
      break;
    case Op::kEndChild:
      return children_.end_child(step.flag) && stack_.is_empty();
    case Op::kEndUnit:
      return tops_.end();
    case Op::kConstant:
    case Op::kUndef:
    case Op::kFalse:
    case Op::kPop:
    case Op::kToBool:
    case Op::kLocal:
    case Op::kTryLocal:
    case Op::kScoped:
    case Op::kTryScoped:
    case Op::kStoreLocal:
    case Op::kNot:
    case Op::kUnlessNumber:
    case Op::kIsUndef:
    case Op::kJump:
    case Op::kJumpIfFalse:
      break;  // run() does these itself
  }
  return false;
}

}  // namespace language
