// The function of a cell while the subdivision works on it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csgcore/blist.hpp"

namespace csgcore {

/// In arrays of primitive indices the top bit may mark a complement, and vectors read so many
/// entries past the last: they must be valid indices.
constexpr uint32_t kVectorPadding = 8;
constexpr uint32_t kPrimitiveBits = 0x7FFFFFFFu;

/// A Blist with its last test first, in separate arrays. The order makes every jump
/// lead to a smaller number, so that one pass restricts and renumbers a list; the constants are
/// numbers too, so that the pass needs no branches.
struct CellList {
  static constexpr uint32_t kFalse = 0;
  static constexpr uint32_t kTrue = 1;
  static constexpr uint32_t kFirst = 2;  // number of the test at index 0
  static constexpr uint32_t kComplementBit = 0x80000000u;

  std::vector<uint32_t> primitive;  // with kComplementBit
  std::vector<uint32_t> if_inside, if_outside;
  /// Number of the test where evaluation starts (the last of the list), or a constant.
  uint32_t root = kFalse;

  bool is_constant() const { return root < kFirst; }
  uint32_t count() const { return is_constant() ? 0 : root - kFirst + 1; }
  std::span<const uint32_t> primitives() const { return {primitive.data(), count()}; }
  /// Makes room for so many tests, and for what vectors read past them.
  void reserve(uint32_t tests);
  /// Ends the list at `root`, and makes what vectors read past it valid.
  void finish(uint32_t last_root);
};

/// `tests` is not empty.
void assign(CellList& list, std::span<const BlistTest> tests);

/// Appends the list in its public form.
void append(std::vector<BlistTest>& tests, const CellList& list);

/// True if the list is a union of its tests (paper §2.2, case 2).
bool is_union(const CellList& list);

}  // namespace csgcore
