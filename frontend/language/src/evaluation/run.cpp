// The loop that runs instructions. What they mostly do stands here, with the place in the code and
// in the stack in registers: arithmetic of numbers, elements of vectors, jumps. All else, also what
// may throw, is left to execute().
#include <cmath>
#include <functional>
#include <memory>

#include "evaluation/machine.hpp"
#include "values/range.hpp"

namespace language {
namespace {

struct Registers {
  const Instruction* at;  // the next instruction
  Value* top;             // behind the last value
  Value* slots;
  const Instruction* code;
  const Value* constants;

  void push(const Value& value) { std::construct_at(top++, value); }
  void drop() { std::destroy_at(--top); }
  // Puts a value where a number or nothing else that needs destruction stands.
  void set(int depth, Value value) { std::construct_at(top - 1 - depth, std::move(value)); }
};

// fmod, which is slow, where whole numbers do not tell the same.
double remainder_of(double left, double right) {
  constexpr double kLimit = 4294967296.0;
  if (left >= 0 && left < kLimit && right >= 1 && right < kLimit) {
    const auto whole_left = static_cast<uint32_t>(left), whole_right = static_cast<uint32_t>(right);
    if (whole_left == left && whole_right == right && !std::signbit(left))
      return whole_left % whole_right;
  }
  return std::fmod(left, right);
}

// Each of the following returns whether it has done what the instruction says.

template <typename Operation>
bool compute(Registers& now, Operation operation) {
  const Value &left = now.top[-1], &right = now.top[-2];
  if (!are_numbers(left, right)) return false;
  now.set(1, operation(left.number(), right.number()));
  --now.top;
  return true;
}

// A jump that follows needs no value.
template <typename Comparison>
bool compare(Registers& now, Comparison comparison) {
  const Value &left = now.top[-1], &right = now.top[-2];
  if (!are_numbers(left, right)) return false;
  const bool is_true = comparison(left.number(), right.number());
  if (now.at->op == Op::kJumpIfFalse) {
    now.top -= 2;
    now.at = is_true ? now.at + 1 : now.code + now.at->b;
    return true;
  }
  now.set(1, Value::boolean(is_true));
  --now.top;
  return true;
}

const Value* element_of(const Value& container, const Value& index) {
  if (!container.is_vector() || !index.is_number()) return nullptr;
  const double position = index.number();
  const auto elements = container.elements();
  if (!(position >= 0 && position < static_cast<double>(elements.size()))) return nullptr;
  return &elements[static_cast<size_t>(position)];
}

bool index(Registers& now) {
  const Value* const element = element_of(now.top[-1], now.top[-2]);
  if (!element) return false;
  now.set(1, *element);
  now.drop();
  return true;
}

bool index_local(Registers& now, const Instruction& step) {
  const Value* const element = element_of(now.slots[step.a], now.top[-1]);
  if (!element) return false;
  now.set(0, *element);
  return true;
}

const Value* member_of(const Value& container, uint16_t position) {
  if (!container.is_vector() || position >= container.elements().size()) return nullptr;
  return position == kNoPosition ? nullptr : &container.elements()[position];
}

bool member(Registers& now, const Instruction& step) {
  const Value* const element = member_of(now.top[-1], step.flag);
  if (!element) return false;
  now.top[-1] = Value(*element);
  return true;
}

bool member_local(Registers& now, const Instruction& step) {
  const Value* const element = member_of(now.slots[step.a], step.flag);
  if (!element) return false;
  now.push(*element);
  return true;
}

bool append(Registers& now, const Instruction& step) {
  auto& vector = static_cast<VectorObject&>(*now.slots[step.b].object());
  if (vector.references != 1 || vector.size == vector.capacity) return false;
  vector.append(std::move(*--now.top));
  return true;
}

void push_next(Registers& now, const Instruction& step) {
  const Value& source = now.slots[step.a];
  Value& done = now.slots[step.a + 1];
  if (!(done.number() < now.slots[step.a + 2].number())) {
    now.at = now.code + step.b;
    return;
  }
  const auto number = static_cast<uint32_t>(done.number());
  if (source.is_vector())
    now.push(source.elements()[number]);
  else
    now.push(source.range().value(number));
  done = number + 1.0;
}

}  // namespace

void Machine::run() {
  Registers now{};
  const auto enter = [&] {
    const Code& code = stack_.code();
    const Instruction* const first = stack_.instructions();
    now = {first + stack_.next(), stack_.values.end(), stack_.values.begin() + stack_.base(), first,
           code.constants.data()};
  };
  enter();
  for (;;) {
    const Instruction& step = *now.at++;
    switch (step.op) {
      case Op::kConstant:
        now.push(now.constants[step.b]);
        continue;
      case Op::kUndef:
        now.push(Value::undef());
        continue;
      case Op::kFalse:
        now.push(Value::boolean(false));
        continue;
      case Op::kPop:
        now.drop();
        continue;
      case Op::kSwap:
        std::swap(now.top[-1], now.top[-2]);
        continue;
      case Op::kToBool:
        now.top[-1] = Value::boolean(now.top[-1].is_true());
        continue;
      case Op::kLocal:
        now.push(now.slots[step.b]);
        continue;
      case Op::kTryLocal:
        if (!now.slots[step.b].is_set()) continue;
        now.push(now.slots[step.b]);
        now.at += step.flag;
        continue;
      case Op::kScoped:
        now.push(stack_.scope_at(step.a)->values()[step.b]);
        continue;
      case Op::kTryScoped: {
        const Value& value = stack_.scope_at(step.a)->values()[step.b];
        if (!value.is_set()) continue;
        now.push(value);
        now.at += step.flag;
        continue;
      }
      case Op::kStoreLocal:
        now.slots[step.b] = std::move(*--now.top);
        continue;
      case Op::kNegate:
        if (!now.top[-1].is_number()) break;
        now.set(0, -now.top[-1].number());
        continue;
      case Op::kNot:
        now.top[-1] = Value::boolean(!now.top[-1].is_true());
        continue;
      case Op::kPower:
        if (compute(now, [](double a, double b) { return std::pow(a, b); })) continue;
        break;
      case Op::kMultiply:
        if (compute(now, std::multiplies())) continue;
        break;
      case Op::kDivide:
        if (compute(now, std::divides())) continue;
        break;
      case Op::kModulo:
        if (compute(now, remainder_of)) continue;
        break;
      case Op::kAdd:
        if (compute(now, std::plus())) continue;
        break;
      case Op::kSubtract:
        if (compute(now, std::minus())) continue;
        break;
      case Op::kLess:
        if (compare(now, std::less())) continue;
        break;
      case Op::kLessEqual:
        if (compare(now, std::less_equal())) continue;
        break;
      case Op::kGreater:
        if (compare(now, std::greater())) continue;
        break;
      case Op::kGreaterEqual:
        if (compare(now, std::greater_equal())) continue;
        break;
      case Op::kEqual:
        if (compare(now, std::equal_to())) continue;
        break;
      case Op::kNotEqual:
        if (compare(now, std::not_equal_to())) continue;
        break;
      case Op::kIndex:
        if (index(now)) continue;
        break;
      case Op::kIndexLocal:
        if (index_local(now, step)) continue;
        break;
      case Op::kMember:
        if (member(now, step)) continue;
        break;
      case Op::kMemberLocal:
        if (member_local(now, step)) continue;
        break;
      case Op::kUnlessNumber:
        if (!now.top[-1].is_number()) now.at = now.code + step.b;
        continue;
      case Op::kIsUndef:
        now.top[-1] = Value::boolean(now.top[-1].is_undef());
        continue;
      case Op::kJump:
        now.at = now.code + step.b;
        continue;
      case Op::kJumpIfFalse: {
        const bool is_true = now.top[-1].is_true();
        now.drop();
        if (!is_true) now.at = now.code + step.b;
        continue;
      }
      case Op::kAppend:
        if (append(now, step)) continue;
        break;
      case Op::kNextRound:
        if (!stack_.steps.count_without_look()) break;
        push_next(now, step);
        continue;
      default:
        break;
    }
    stack_.jump(static_cast<uint32_t>(now.at - now.code));
    stack_.values.set_end(now.top);
    if (execute(step)) return;
    enter();
  }
}

}  // namespace language
