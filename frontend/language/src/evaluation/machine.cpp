#include "evaluation/machine.hpp"

#include <unistd.h>

#include <chrono>

#include "code/expression_facts.hpp"
#include "language/make.hpp"
#include "values/object_memory.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

constexpr uint32_t kEmptyTrail = 0;

// What rands() uses until a call seeds it: another seed at each start.
std::mt19937 seeded_generator() {
  const auto time = std::chrono::system_clock::now().time_since_epoch().count();
  return std::mt19937(static_cast<uint32_t>(time ^ getpid()));
}

}  // namespace

Machine::Machine(Compiler& compiler, Messages& messages, ModuleEnvironment& modules, NodeTree& tree,
                 std::stop_token stop)
    : compiler_(compiler),
      messages_(messages),
      modules_(modules),
      tree_(tree),
      functions_{messages, modules.files, seeded_generator(), {}},
      stop_(std::move(stop)),
      builtin_functions_(builtin_functions()),
      builtin_modules_(builtin_modules()),
      dynamic_(compiler.names().size()),
      dependencies_(0),
      definitions_(0),
      variables_(0),
      kept_units_(compiler.program().units.size()),
      fragments_number_(compiler.names().find("$fn")),
      fragments_angle_(compiler.names().find("$fa")),
      fragments_size_(compiler.names().find("$fs")),
      parent_modules_(compiler.names().find("$parent_modules")) {
  if (const Scope* const scope = compiler.program().units[0].scope) {
    definitions_ = static_cast<uint32_t>(scope->functions.size() + scope->modules.size());
    variables_ = static_cast<uint32_t>(scope->assignments.size());
  }
  dependencies_ = DependencyLog(read_number(0) + compiler.names().size());
  unit_ = kNoUnit;
  set_unit(0);
}

Machine::~Machine() {
  // Values go before the scopes and the constants that they share.
  stack_.drop_to(0);
  dynamic_.undo(kEmptyTrail);
}

void Machine::preset(std::string_view name, Value value) {
  dynamic_.bind(compiler_.names().find(name), std::move(value));
}

Value Machine::top_level_value(std::string_view text) const {
  const Name name = compiler_.names().find(text);
  return dynamic_.is_bound_since(name, preset_trail_) ? dynamic_[name] : Value::unset();
}

ValueType Machine::type_of(const Expression& expression) {
  const Value constant = constant_value(expression);
  if (constant.is_set()) return constant.type();
  FunctionEntry& function = compiler_.add_expression(expression);
  push_frame(compiler_.code_of(function), stack_.size(), scopes_.make(nullptr, 0),
             FrameKind::kFunction, kNoActivation);
  frames_.back().function = &function;
  run_guarded();
  return stack_.pop().type();
}

void Machine::run_assignments() {
  UnitEntry& main = compiler_.unit(0);
  main_scope_ = scopes_.make(nullptr, main.scope->size());
  push_frame(*main.assignments, stack_.size(), HeapScopes::acquire(main_scope_),
             FrameKind::kMainUnit, kNoActivation);
  preset_trail_ = dynamic_.trail();
  run_guarded();
  main_trail_ = dynamic_.trail();
}

void Machine::run_calls() {
  const Code& code = compiler_.code_of(compiler_.unit(0).calls);
  push_frame(code, stack_.size(), HeapScopes::acquire(main_scope_), FrameKind::kBlock,
             kNoActivation);
  run_guarded();
}

void Machine::end_early() {
  if (main_trail_) dynamic_.undo(main_trail_);
}

void Machine::run_guarded() {
  try {
    run();
  } catch (const HardWarning&) {
    say_traces();
    throw Aborted();
  } catch (const TooLarge& problem) {
    fail(problem.what(), place());
  } catch (const OutOfValueMemory&) {
    fail("The design's values take too much memory", place());
  } catch (const std::bad_alloc&) {
    fail("The design takes too much memory", place());
  }
}

// Each case does what the instruction's comment in code/instruction.hpp says.
bool Machine::execute(const Instruction& step) {
  switch (step.op) {
    case Op::kSlide: {
      Value value = stack_.pop();
      stack_.drop_to(stack_.size() - step.b);
      stack_.push(std::move(value));
      break;
    }
    case Op::kDynamic:
      push_dynamic(step.b, false);
      break;
    case Op::kDynamicSilently:
      push_dynamic(step.b, true);
      break;
    case Op::kUnknownVariable:
      unknown_variable(step.b);
      break;
    case Op::kStoreScoped:
      store_scoped(step);
      break;
    case Op::kBindDynamic:
      dynamic_.bind(step.b, stack_.pop());
      break;
    case Op::kMarkTrail:
      stack_.push(static_cast<double>(dynamic_.trail()));
      break;
    case Op::kUndoTrail:
      dynamic_.undo(static_cast<uint32_t>(stack_[base_ + step.b].number()));
      break;
    case Op::kEndDynamic: {
      Value value = stack_.pop();
      dynamic_.undo(static_cast<uint32_t>(stack_.pop().number()));
      stack_.push(std::move(value));
      break;
    }
    case Op::kPushScope:
      push_scope(step.b);
      break;
    case Op::kPopScope:
      pop_scope();
      break;
    case Op::kNegate:
      unary(operators::negate);
      break;
    case Op::kComplement:
      unary(operators::complement);
      break;
    case Op::kPower:
      binary(operators::power);
      break;
    case Op::kMultiply:
      binary(operators::multiply);
      break;
    case Op::kDivide:
      binary(operators::divide);
      break;
    case Op::kModulo:
      binary(operators::modulo);
      break;
    case Op::kAdd:
      binary(operators::add);
      break;
    case Op::kSubtract:
      binary(operators::subtract);
      break;
    case Op::kShiftLeft:
      binary(operators::shift_left);
      break;
    case Op::kShiftRight:
      binary(operators::shift_right);
      break;
    case Op::kBitAnd:
      binary(operators::bit_and);
      break;
    case Op::kBitOr:
      binary(operators::bit_or);
      break;
    case Op::kLess:
      binary(operators::less);
      break;
    case Op::kLessEqual:
      binary(operators::less_equal);
      break;
    case Op::kGreater:
      binary(operators::greater);
      break;
    case Op::kGreaterEqual:
      binary(operators::greater_equal);
      break;
    case Op::kEqual:
    case Op::kNotEqual: {
      const Value left = stack_.pop();
      stack_.top() = Value::boolean(equal(left, stack_.top()) == (step.op == Op::kEqual));
      break;
    }
    case Op::kIndex: {
      const Value container = stack_.pop();
      stack_.top() = element_at(container, stack_.top());
      break;
    }
    case Op::kMember:
      stack_.top() = member(stack_.top(), compiler_.names().text(step.b));
      break;
    case Op::kIndexLocal:
      stack_.top() = element_at(stack_[base_ + step.a], stack_.top());
      break;
    case Op::kMemberLocal:
      stack_.push(member(stack_[base_ + step.a], compiler_.names().text(step.b)));
      break;
    case Op::kRange:
      make_range(step.flag);
      break;
    case Op::kVector:
      make_vector(step.b);
      break;
    case Op::kFunction:
      make_closure(step.b);
      break;
    case Op::kAssert:
      assert_top(frames_.back().code->asserts[step.b], step.flag);
      break;
    case Op::kEcho:
      echo(frames_.back().code->echoes[step.b]);
      break;
    case Op::kDuplicateLet:
      duplicate_let(step.b);
      break;
    case Op::kUnnamedLet:
      unnamed_let();
      break;
    case Op::kBeginVector:
      stack_.push(language::make_vector());
      break;
    case Op::kAppend:
      append_element(stack_[base_ + step.b], stack_.pop());
      break;
    case Op::kAppendEach:
      append_each(step.b);
      break;
    case Op::kAppendEachOfAll:
      append_each_of_all(step.b);
      break;
    case Op::kBeginLoop:
      begin_loop(step.flag);
      break;
    case Op::kReserve:
      make_room(stack_[base_ + step.b], static_cast<size_t>(stack_.top().number()));
      break;
    case Op::kNextRound:
      if (!next_round(base_ + step.a)) next_ = step.b;
      break;
    case Op::kCountRound:
      count_round(step.b);
      break;
    case Op::kEnterUnit:
      enter_unit(step.b);
      break;
    case Op::kBeginCall:
      begin_call(frames_.back().code->calls[step.b]);
      break;
    case Op::kCall:
      call_function(frames_.back().code->calls[step.b]);
      break;
    case Op::kCallBuiltin:
      if (step.flag != 0) stack_[base_ + step.flag - 1] = Value::undef();
      call_builtin(step.b, step.a);
      break;
    case Op::kNextLazy:
      next_lazy(frames_.back().code->lazy_calls[step.b]);
      break;
    case Op::kKeepLazy:
      keep_lazy(frames_.back().code->lazy_calls[step.b]);
      break;
    case Op::kWarnCount:
      warn_count(step.b);
      break;
    case Op::kUnknownFunction:
      unknown_function(step.b);
      break;
    case Op::kArgumentWarnings:
      say_argument_warnings(step.b, step.flag);
      break;
    case Op::kIfFunction:
      if (stack_.top().is_function()) next_ = step.b;
      break;
    case Op::kPrepareCall:
      prepare_call(frames_.back().code->dynamic_calls[step.b]);
      break;
    case Op::kNextArgument:
      next_argument(frames_.back().code->dynamic_calls[step.b]);
      break;
    case Op::kCallDynamic:
      call_dynamic(frames_.back().code->dynamic_calls[step.b]);
      break;
    case Op::kUnlessCalledAs:
      if (frames_.back().called_as != step.a) next_ = step.b;
      break;
    case Op::kCachedDefault: {
      note_history();
      const Value& cached = frames_.back().code->caches[step.a];
      if (!cached.is_set()) break;
      stack_.push_copy(cached);
      next_ = step.b;
      break;
    }
    case Op::kStoreCache:
      frames_.back().code->caches[step.a] = stack_.top();
      break;
    case Op::kTailJump:
      tail_jump(step.a, step.b);
      break;
    case Op::kReturn:
      return_value();
      return frames_.empty();
    case Op::kReturnDefaults:
      return_defaults();
      break;
    case Op::kUnknownModule:
      unknown_module(step.b);
      break;
    case Op::kBeginNode:
      begin_node(frames_.back().code->node_sites[step.b]);
      break;
    case Op::kEndNode:
      end_node(step.flag);
      break;
    case Op::kSuccessor:
      say_successor(frames_.back().code->node_sites[step.b]);
      break;
    case Op::kRefuseChildren:
      refuse_children(frames_.back().code->node_sites[step.b]);
      break;
    case Op::kWantsFirst:
      if (!wants_first(frames_.back().code->node_sites[step.a])) next_ = step.b;
      break;
    case Op::kMakeNode:
      make_node(frames_.back().code->node_sites[step.a], step.b, step.flag);
      break;
    case Op::kSaveBlock:
      block_scopes_.push_back(HeapScopes::acquire(scope_));
      break;
    case Op::kNameModule:
      name_module(frames_.back().code->calls[step.b].module->name);
      break;
    case Op::kCallModule:
      call_module(frames_.back().code->calls[step.b]);
      break;
    case Op::kChildCount:
      stack_.push(static_cast<double>(child_count()));
      break;
    case Op::kParameterLiteral:
      parameter_literal(step.b, step.a);
      break;
    case Op::kReturnModule:
      return_module();
      break;
    case Op::kUnlessInModule:
      if (!activation()) next_ = step.b;
      break;
    case Op::kAllChildren:
      all_children(frames_.back().code->node_sites[step.b]);
      break;
    case Op::kDeprecatedChild:
      say_child_is_deprecated();
      break;
    case Op::kSelectChildren:
      if (!select_children(frames_.back().code->node_sites[step.a], step.flag)) next_ = step.b;
      break;
    case Op::kNextChild:
      next_child(base_ + step.a, step.b);
      break;
    case Op::kEndSelection:
      end_selection();
      break;
    case Op::kEndChild:
      return end_child(step.flag) && frames_.empty();
    case Op::kEndUnit:
      return end_unit();
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
