// A CSG expression as a list of tests with jumps.
//
// The Boolean function of a cell is kept as the order in which short-circuit evaluation would test
// its primitives, each test with the place to go on from if the point is inside the primitive and
// the place if it is outside (the Blist form that Hable and Rossignac [paper, ref. 7, 12] evaluate
// on the GPU). Why this form and neither a tree nor a truth table:
// - one form serves a cell of two primitives and the whole scene: evaluation needs no stack, at any
//   depth of nesting, on the CPU and in a shader;
// - n-ary and binary operations, differences and complements are all the same jumps: a complement
//   swaps the two targets;
// - evaluation visits only what decides, so that primitives which don't matter on a ray are never
//   intersected; a truth table needs all of them, and 2^K bits;
// - restricting it to a cell (paper §2.2.1) is two linear passes, bottom up, and yields the
//   irreducible expression.
//
// Example: (A ∪ B) − C is
//   0: A   inside → 2      outside → 1
//   1: B   inside → 2      outside → false
//   2: C   inside → false  outside → true     (complement: C's surface bounds from outside)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"

namespace csgcore {

/// Jump targets that end the evaluation.
constexpr uint32_t kListTrue = 0xFFFFFFFFu;
constexpr uint32_t kListFalse = 0xFFFFFFFEu;

/// One test. Targets are positions in the list, always greater than the test's own, or kListTrue or
/// kListFalse.
struct BlistTest {
  uint32_t primitive : 31;
  /// The primitive's complement bounds the solid: its surface is a cut face and its outward normal
  /// points into the primitive (paper §3.2, step 4).
  uint32_t complement : 1;
  uint32_t if_inside;
  uint32_t if_outside;

  uint32_t if_true() const { return complement ? if_outside : if_inside; }
  uint32_t if_false() const { return complement ? if_inside : if_outside; }
  bool operator==(const BlistTest&) const = default;
};

/// A list with no tests is constant: `constant` tells whether it holds everywhere or nowhere.
struct Blist {
  std::vector<BlistTest> tests;
  bool constant = false;
};

/// Compiles a tree in postfix order, normal form or not, in time proportional to its tokens and
/// without recursion. The empty tree is the constant false.
Blist compile(std::span<const CsgToken> tokens);
inline Blist compile(const CsgTree& tree) { return compile(tree.tokens()); }

/// Evaluates a non-empty list; `inside(primitive)` answers for each primitive that decides.
template <typename Inside>
bool evaluate(std::span<const BlistTest> tests, Inside&& inside) {
  uint32_t i = 0;
  do {
    const BlistTest& test = tests[i];
    i = inside(static_cast<uint32_t>(test.primitive)) ? test.if_inside : test.if_outside;
  } while (i < kListFalse);
  return i == kListTrue;
}

/// True if the list is a union of its tests: the paper's case 2 (§2.2). A single test is one.
bool is_union(std::span<const BlistTest> tests);

}  // namespace csgcore
