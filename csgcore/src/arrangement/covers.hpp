// Operands that decide by themselves, somewhere, what a part of the CSG tree holds: there the
// surfaces of all else in that part do not matter.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/facet_trees.hpp"
#include "csgcore/csg_tree.hpp"

namespace csgcore {

/// A subtree that an operand decides by itself where it holds a point, or where it does not: its
/// tokens. It is empty if there is none.
struct Decided {
  size_t begin = 0;
  size_t end = 0;

  bool holds(size_t token) const { return begin <= token && token < end; }
};

/// Which subtrees operands decide.
class Decisions {
 public:
  Decisions(std::span<const CsgToken> tokens, size_t operands);

  /// Returns whether the operand, where it holds a point or does not, decides all that `other`
  /// is part of.
  bool decides(uint32_t operand, bool is_held, uint32_t other) const {
    return leaf_of_[other] != kNowhere && decided_[operand][is_held ? 1 : 0].holds(leaf_of_[other]);
  }

  /// Returns whether `is_wanted` takes an operand that decides the other one where it does not hold
  /// a point. The tree's nesting is not bounded: operations far above are left out.
  template <class IsWanted>
  bool any_decides_outside(uint32_t other, IsWanted is_wanted) const {
    constexpr int kHighest = 64;
    size_t node = leaf_of_[other];
    for (int i = 0; i < kHighest && node != kNowhere; ++i, node = parent_of_[node]) {
      if (std::ranges::any_of(outside_at_[node], is_wanted)) return true;
    }
    return false;
  }

 private:
  static constexpr size_t kNowhere = ~size_t{0};

  std::vector<size_t> leaf_of_;                    // by operand
  std::vector<std::array<Decided, 2>> decided_;    // by operand: outside of it, and inside
  std::vector<size_t> parent_of_;                  // by token
  std::vector<std::vector<uint32_t>> outside_at_;  // by token: which decide it outside of them
};

/// The operands in space, and what they decide there.
class Covers {
 public:
  /// Keeps a reference to the trees.
  Covers(const Facets& facets, const FacetTrees& trees, std::span<const CsgToken> tokens,
         const std::vector<bool>& may_cross_itself);

  const Decisions& decisions() const { return decisions_; }

  /// Calls visit(operand) for those whose boxes meet this one, until it returns true. Returns
  /// whether it did.
  template <class Visit>
  bool visit(const FacetBox& box, Visit visit) const {
    return operands_.visit([&](const FacetBox& other) { return other.meets(box); },
                           [&](uint32_t begin, uint32_t end) {
                             return std::any_of(placed_.begin() + begin, placed_.begin() + end,
                                                visit);
                           });
  }

  /// Returns whether the points surely lie within the operand, and all that is between them does;
  /// each may be off by a quarter of the grid's unit. It is so if they lie behind all of its
  /// facets: every way out of there passes a facet from behind. False may be wrong.
  bool hold(uint32_t operand, std::span<const Vec3> points) const;

  /// Returns whether a third operand surely holds all of a segment, and so decides both of these;
  /// its ends as above. `last` is the third of an earlier call, which may be so again, or kNoPlace.
  bool hide(const std::array<Vec3, 2>& ends, uint32_t a, uint32_t b, uint32_t& last) const;

 private:
  /// Behind a facet: normal·x < offset, the normal of length 1.
  struct Behind {
    Vec3 normal;
    double offset;
  };

  const FacetTrees& trees_;
  Decisions decisions_;
  BoxTree operands_;
  std::vector<uint32_t> placed_;                            // operands in the order of that tree
  std::vector<std::vector<Behind>> behind_;                 // by operand; empty: it is not asked
  mutable std::vector<std::atomic<uint32_t>> last_before_;  // by operand: a facet that denied
};

}  // namespace csgcore
