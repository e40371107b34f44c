#include "csgcore/blist.hpp"

namespace csgcore {
namespace {

/// An operation whose operands are being compiled, the last one first.
struct Pending {
  Op op;
  bool complement;
  uint32_t operands_left;
  uint32_t if_true, if_false;  // where the whole operation continues
  uint32_t next;               // start of the operand compiled before, which follows in the list
  bool is_last_operand;
};

/// The jump targets of the operand that is compiled next.
struct Continuation {
  uint32_t if_true, if_false;
  bool complement;
};

/// Applies the rules of short-circuit evaluation: a union goes on to its next operand while false,
/// an intersection while true. A difference is an intersection whose later operands are
/// complements.
Continuation continuation_of(const Pending& pending) {
  const uint32_t next_true = pending.is_last_operand ? pending.if_true : pending.next;
  const uint32_t next_false = pending.is_last_operand ? pending.if_false : pending.next;
  switch (pending.op) {
    case Op::kUnion:
      return {pending.if_true, next_false, pending.complement};
    case Op::kIntersection:
      return {next_true, pending.if_false, pending.complement};
    case Op::kDifference:
      if (pending.operands_left == 1) return {next_true, pending.if_false, pending.complement};
      return {pending.if_false, next_true, !pending.complement};
  }
  return {};
}

}  // namespace

Blist compile(std::span<const CsgToken> tokens) {
  Blist list;
  uint32_t position = 0;
  for (const CsgToken& token : tokens) position += token.is_primitive;
  list.tests.resize(position);

  // Compiling backwards from the root, every jump leads to a test that is already there.
  std::vector<Pending> stack;
  for (size_t i = tokens.size(); i-- > 0;) {
    const CsgToken& token = tokens[i];
    const Continuation to =
        stack.empty() ? Continuation{kListTrue, kListFalse, false} : continuation_of(stack.back());
    if (!token.is_primitive) {
      stack.push_back({token.op, to.complement, token.value, to.if_true, to.if_false, 0, true});
      continue;
    }
    BlistTest& test = list.tests[--position];
    test.primitive = token.value & 0x7FFFFFFFu;
    test.complement = to.complement;
    test.if_inside = to.if_true;
    test.if_outside = to.if_false;
    while (!stack.empty()) {
      Pending& parent = stack.back();
      parent.next = position;
      parent.is_last_operand = false;
      if (--parent.operands_left > 0) break;
      stack.pop_back();
    }
  }
  return list;
}

bool is_union(std::span<const BlistTest> tests) {
  for (size_t i = 0; i + 1 < tests.size(); ++i) {
    if (tests[i].if_true() != kListTrue) return false;
  }
  return true;
}

}  // namespace csgcore
