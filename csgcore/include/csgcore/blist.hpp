// A CSG expression as a Boolean list: tests with jumps.
//
// The Boolean function of a cell says, for a point of the cell, whether the point lies in the
// solid. It is kept as a list of tests in the order of short-circuit evaluation. Each test asks
// whether the point lies in one primitive, and has two jump targets: where evaluation continues if
// it does and if it does not. This is the Blist form, which Hable and Rossignac evaluate on the GPU
// [paper, ref. 7, 12]. Its advantages over a tree or a truth table:
// - one form serves a cell of two primitives and the whole scene: evaluation needs no stack, at any
//   depth of nesting, on the CPU and in a shader;
// - n-ary and binary operations, differences and complements are all the same jumps: a complement
//   swaps the two targets;
// - evaluation visits only tests that decide, so that primitives which do not matter on a ray are
//   never intersected; a truth table needs all of them, and 2^K bits;
// - two linear passes restrict a list to a cell (paper §2.2.1) and yield the irreducible
//   expression.
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

/// One test. A jump target is a position in the list, which is greater than the test's own, or
/// kListTrue or kListFalse.
struct BlistTest {
  uint32_t primitive : 31;
  /// The operand is the complement of the primitive. The primitive's surface is then a cut face of
  /// the solid, whose outward normal points into the primitive (paper §3.2, step 4).
  uint32_t complement : 1;
  uint32_t if_inside;
  uint32_t if_outside;

  uint32_t if_true() const { return complement ? if_outside : if_inside; }
  uint32_t if_false() const { return complement ? if_inside : if_outside; }
  bool operator==(const BlistTest&) const = default;
};

/// A list without tests is constant: `constant` says whether it is true everywhere or nowhere.
/// `constant` has no meaning otherwise.
struct Blist {
  std::vector<BlistTest> tests;
  bool constant = false;
};

/// Compiles a tree in postfix order, which need not be in normal form, in time proportional to its
/// tokens and without recursion. The empty tree becomes the constant false.
Blist compile(std::span<const CsgToken> tokens);
inline Blist compile(const CsgTree& tree) { return compile(tree.tokens()); }

/// Evaluates a non-empty list at a point. `inside(primitive)` says whether the point lies in that
/// primitive, and is called only for tests that evaluation reaches.
template <typename Inside>
bool evaluate(std::span<const BlistTest> tests, Inside&& inside) {
  uint32_t i = 0;
  do {
    const BlistTest& test = tests[i];
    i = inside(static_cast<uint32_t>(test.primitive)) ? test.if_inside : test.if_outside;
  } while (i < kListFalse);
  return i == kListTrue;
}

/// Returns whether the list is the union of its tests' operands: the paper's case 2 (§2.2). A
/// single test is a union.
bool is_union(std::span<const BlistTest> tests);

}  // namespace csgcore
