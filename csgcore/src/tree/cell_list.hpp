// The Boolean list of a cell or tile while it is being restricted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/blist.hpp"

namespace csgcore {

/// Vectors read up to kVectorPadding entries past the end of an array of primitive indices, so that
/// valid indices must follow the last entry. The top bit of an entry may mark a complement;
/// kPrimitiveBits are the rest.
constexpr uint32_t kVectorPadding = 8;
constexpr uint32_t kPrimitiveBits = 0x7FFFFFFFu;

/// A Blist in reverse order, in separate arrays. The tests are numbered from kFirst on, the last
/// test of the Blist first, so that every jump leads to a smaller number and one pass restricts and
/// renumbers a list. The constants are numbers, too, which spares the pass branches.
struct CellList {
  static constexpr uint32_t kFalse = 0;
  static constexpr uint32_t kTrue = 1;
  static constexpr uint32_t kFirst = 2;  // the number of the test at index 0
  static constexpr uint32_t kComplementBit = 0x80000000u;

  std::vector<uint32_t> primitive;  // with kComplementBit where the operand is a complement
  std::vector<uint32_t> if_inside, if_outside;
  /// Number of the test where evaluation starts (the last of the list), or a constant.
  uint32_t root = kFalse;

  bool is_constant() const { return root < kFirst; }
  uint32_t count() const { return is_constant() ? 0 : root - kFirst + 1; }
  std::span<const uint32_t> primitives() const { return {primitive.data(), count()}; }
  /// Makes room for so many tests and for the padding that vectors read.
  void reserve(uint32_t tests);
  /// Makes `last_root` the root, and fills the padding behind it with a valid index.
  void finish(uint32_t last_root);
};

/// Replaces the list by `tests`, which must not be empty.
void assign(CellList& list, std::span<const BlistTest> tests);

/// Appends the list as BlistTests, whose jump targets count from its first test.
void append(std::vector<BlistTest>& tests, const CellList& list);

/// Returns whether the list is the union of its tests' operands (paper §2.2, case 2).
bool is_union(const CellList& list);

}  // namespace csgcore
