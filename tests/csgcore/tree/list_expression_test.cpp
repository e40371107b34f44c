// Tests that Blists are read as the expressions that they were compiled from.
#include "tree/list_expression.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "solid/restriction.hpp"
#include "support/models.hpp"

namespace csgcore {
namespace {

using Step = ListExpression::Step;

/// Evaluates the expression by the states of its tests, or its complement by those of their
/// complements.
int32_t evaluate_states(const CellList& list, const std::vector<int32_t>& state_of_test,
                        bool complement = false) {
  ListExpression expression;
  expression.parse(list);
  std::vector<int32_t> stack;
  size_t index = 0;
  for (const Step step : expression.steps()) {
    if (step == Step::kTest) {
      stack.push_back(state_of_test[index++]);
      continue;
    }
    const int32_t last = stack.back();
    stack.pop_back();
    stack.back() = (step == Step::kUnion) != complement
                       ? turning::union_of(stack.back(), last)
                       : turning::intersection_of(stack.back(), last);
  }
  EXPECT_EQ(index, list.count());
  EXPECT_EQ(stack.size(), 1u);
  return stack.empty() ? turning::kFails : stack.back();
}

bool is_complement(const CellList& list, uint32_t i) {
  return (list.primitive[i] & CellList::kComplementBit) != 0;
}

/// Evaluates the list by its jumps.
bool holds(const CellList& list, const std::vector<uint8_t>& inside) {
  uint32_t number = list.root;
  while (number >= CellList::kFirst) {
    const uint32_t i = number - CellList::kFirst;
    number = inside[i] ? list.if_inside[i] : list.if_outside[i];
  }
  return number == CellList::kTrue;
}

/// A random tree, and its list with some primitives decided.
struct RandomList {
  CsgTree tree;
  std::vector<Restrictor::Decision> decisions;  // by primitive
  CellList list;
};

RandomList random_list(std::mt19937& random, uint32_t seed) {
  const Scene scene = test_support::random_tree(1 + random() % 20, seed);
  RandomList result;
  result.tree = scene.model;
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    const uint32_t kind = random() % 8;
    result.decisions.push_back(kind == 0   ? Restrictor::Decision::kInside
                               : kind == 1 ? Restrictor::Decision::kOutside
                                           : Restrictor::Decision::kOpen);
  }
  CellList whole;
  assign(whole, compile(scene.model).tests);
  std::vector<Restrictor::Decision> decisions(whole.count());
  for (uint32_t i = 0; i < whole.count(); ++i) {
    decisions[i] = result.decisions[whole.primitive[i] & kPrimitiveBits];
  }
  const WorldClassifier none(std::span<const CanonicalPrimitive>{});
  Restrictor({}, none).restrict(whole, decisions, result.list);
  return result;
}

TEST(ListExpression, HoldsWhereTheListDoes) {
  std::mt19937 random(1);
  uint32_t tests = 0;
  for (uint32_t seed = 1; seed <= 500; ++seed) {
    const CellList list = random_list(random, seed).list;
    if (list.is_constant()) continue;
    tests = std::max(tests, list.count());
    for (int round = 0; round < 10; ++round) {
      std::vector<uint8_t> inside(list.count());
      std::vector<int32_t> states(list.count());
      for (uint32_t i = 0; i < list.count(); ++i) {
        inside[i] = random() % 2;
        states[i] = (inside[i] != 0) != is_complement(list, i) ? turning::kHolds : turning::kFails;
      }
      EXPECT_EQ(evaluate_states(list, states) == turning::kHolds, holds(list, inside));
    }
  }
  EXPECT_GT(tests, 15u);
}

/// The definition (NUMERICS.md): the value of a tree before and behind some changes of primitives,
/// and the last primitive to which its turn is due.
struct Turn {
  bool before, behind;
  uint32_t last;  // kNobody if none
};
constexpr uint32_t kNobody = 0xFFFFFFFFu;

Turn turn_of(const CsgTree& tree, const std::vector<uint8_t>& before,
             const std::vector<uint8_t>& behind) {
  std::vector<Turn> operands;
  for (const CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      const bool turns = before[token.value] != behind[token.value];
      operands.push_back(
          {before[token.value] != 0, behind[token.value] != 0, turns ? token.value : kNobody});
      continue;
    }
    const std::span<const Turn> own = std::span(operands).last(token.value);
    const auto value = [&](auto&& of) {
      bool result = token.op != Op::kUnion;
      for (size_t k = 0; k < own.size(); ++k) {
        const bool holds = of(own[k]) != (token.op == Op::kDifference && k > 0);
        result = token.op == Op::kUnion ? result || holds : result && holds;
      }
      return result;
    };
    Turn turn{value([](const Turn& t) { return t.before; }),
              value([](const Turn& t) { return t.behind; }), kNobody};
    for (size_t k = 0; k < own.size() && turn.before != turn.behind; ++k) {
      const bool is_subtracted = token.op == Op::kDifference && k > 0;
      if (own[k].before == own[k].behind || (own[k].behind != is_subtracted) != turn.behind) {
        continue;
      }
      if (own[k].last != kNobody && (turn.last == kNobody || own[k].last > turn.last)) {
        turn.last = own[k].last;
      }
    }
    operands.resize(operands.size() - token.value);
    operands.push_back(turn);
  }
  return operands.back();
}

TEST(ListExpression, TurnsByTheLastPrimitiveThatTheTurnIsDueTo) {
  std::mt19937 random(2);
  uint32_t started = 0;
  uint32_t ended = 0;
  for (uint32_t seed = 1; seed <= 8000; ++seed) {
    const RandomList made = random_list(random, seed);
    const CellList& list = made.list;
    if (list.is_constant()) continue;
    std::vector<uint8_t> before(made.decisions.size()), behind(made.decisions.size());
    for (size_t i = 0; i < before.size(); ++i) {
      const Restrictor::Decision decision = made.decisions[i];
      const bool is_open = decision == Restrictor::Decision::kOpen;
      before[i] = is_open ? random() % 2 : decision == Restrictor::Decision::kInside;
      behind[i] = before[i] != (is_open && random() % 3 == 0);
    }
    const Turn turn = turn_of(made.tree, before, behind);
    if (turn.before == turn.behind) continue;
    // Where the solid ends, its complement starts.
    const bool ends = turn.before;
    std::vector<int32_t> states(list.count());
    for (uint32_t i = 0; i < list.count(); ++i) {
      const uint32_t primitive = list.primitive[i] & kPrimitiveBits;
      const bool negated = is_complement(list, i) != ends;
      states[i] = turning::state_of((before[primitive] != 0) != negated,
                                    (behind[primitive] != 0) != negated, primitive);
    }
    ASSERT_EQ(static_cast<uint32_t>(evaluate_states(list, states, ends)), turn.last)
        << "seed " << seed;
    ++(ends ? ended : started);
  }
  EXPECT_GT(started, 300u);
  EXPECT_GT(ended, 300u);
}

}  // namespace
}  // namespace csgcore
