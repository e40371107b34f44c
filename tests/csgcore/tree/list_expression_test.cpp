// Lists are read as the expressions that they were compiled from.
#include "tree/list_expression.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "solid/restriction.hpp"
#include "support/models.hpp"

namespace csgcore {
namespace {

using Step = ListExpression::Step;

/// Evaluates it by literals' states, without the negation that an end of the solid asks for.
int32_t evaluate_states(const CellList& list, const std::vector<int32_t>& state_of_literal) {
  ListExpression expression;
  expression.parse(list);
  std::vector<int32_t> stack;
  size_t index = 0;
  for (const Step step : expression.steps()) {
    if (step == Step::kLiteral) {
      stack.push_back(state_of_literal[index++]);
      continue;
    }
    const int32_t last = stack.back();
    stack.pop_back();
    stack.back() = step == Step::kUnion ? turning::union_of(stack.back(), last)
                                        : turning::intersection_of(stack.back(), last);
  }
  EXPECT_EQ(index, list.count());
  EXPECT_EQ(stack.size(), 1u);
  return stack.empty() ? turning::kFails : stack.back();
}

bool is_complement(const CellList& list, uint32_t i) {
  return (list.primitive[i] & CellList::kComplementBit) != 0;
}

/// By the list's jumps.
bool holds(const CellList& list, const std::vector<uint8_t>& inside) {
  uint32_t number = list.root;
  while (number >= CellList::kFirst) {
    const uint32_t i = number - CellList::kFirst;
    number = inside[i] ? list.if_inside[i] : list.if_outside[i];
  }
  return number == CellList::kTrue;
}

/// Of a random tree, with some literals decided.
CellList random_list(std::mt19937& random, uint32_t seed) {
  const Scene scene = test_support::random_tree(1 + random() % 20, seed);
  CellList whole, list;
  assign(whole, compile(scene.model).literals);
  std::vector<Restrictor::Decision> decisions(whole.count());
  for (Restrictor::Decision& decision : decisions) {
    const uint32_t kind = random() % 8;
    decision = kind == 0   ? Restrictor::Decision::kInside
               : kind == 1 ? Restrictor::Decision::kOutside
                           : Restrictor::Decision::kOpen;
  }
  const WorldClassifier none(std::span<const CanonicalPrimitive>{});
  Restrictor({}, none).restrict(whole, decisions, list);
  return list;
}

TEST(ListExpression, HoldsWhereTheListDoes) {
  std::mt19937 random(1);
  uint32_t literals = 0;
  for (uint32_t seed = 1; seed <= 500; ++seed) {
    const CellList list = random_list(random, seed);
    if (list.is_constant()) continue;
    literals = std::max(literals, list.count());
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
  EXPECT_GT(literals, 15u);
}

/// A change counts if the value turns by it, some of the other changes that go the same way undone.
uint32_t last_that_counts(const CellList& list, const std::vector<uint8_t>& behind,
                          const std::vector<uint32_t>& changed) {
  uint32_t last = 0xFFFFFFFFu;
  for (uint32_t undone = 0; undone < 1u << changed.size(); ++undone) {
    std::vector<uint8_t> inside = behind;
    for (size_t k = 0; k < changed.size(); ++k) {
      if (undone >> k & 1) inside[changed[k]] ^= 1;
    }
    if (!holds(list, inside)) continue;
    for (size_t k = 0; k < changed.size(); ++k) {
      if (undone >> k & 1) continue;
      inside[changed[k]] ^= 1;
      const uint32_t primitive = list.primitive[changed[k]] & kPrimitiveBits;
      if (!holds(list, inside) && (last == 0xFFFFFFFFu || primitive > last)) last = primitive;
      inside[changed[k]] ^= 1;
    }
  }
  return last;
}

TEST(ListExpression, TurnsByTheLastChangeThatCounts) {
  std::mt19937 random(2);
  uint32_t turned = 0;
  uint32_t several = 0;
  for (uint32_t seed = 1; seed <= 8000; ++seed) {
    const CellList list = random_list(random, seed);
    if (list.is_constant()) continue;
    std::vector<uint8_t> before(list.count()), behind(list.count());
    std::vector<uint32_t> towards;  // literals that become true
    for (uint32_t i = 0; i < list.count(); ++i) {
      before[i] = random() % 2;
      const bool changes = random() % 3 == 0;
      behind[i] = before[i] != changes;
      if (changes && (behind[i] != 0) != is_complement(list, i) && towards.size() < 8) {
        towards.push_back(i);
      } else if (changes && (behind[i] != 0) != is_complement(list, i)) {
        before[i] = behind[i];
      }
    }
    if (holds(list, before) || !holds(list, behind)) continue;
    std::vector<int32_t> states(list.count());
    for (uint32_t i = 0; i < list.count(); ++i) {
      states[i] = turning::state_of((before[i] != 0) != is_complement(list, i),
                                    (behind[i] != 0) != is_complement(list, i),
                                    list.primitive[i] & kPrimitiveBits);
    }
    ASSERT_EQ(static_cast<uint32_t>(evaluate_states(list, states)),
              last_that_counts(list, behind, towards))
        << "seed " << seed;
    ++turned;
    several += towards.size() > 1;
  }
  EXPECT_GT(turned, 300u);
  EXPECT_GT(several, 100u);
}

}  // namespace
}  // namespace csgcore
