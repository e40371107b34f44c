// A solid's list with its operands in groups: what is far from where one looks costs nothing.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/extent.hpp"
#include "solid/soa_bounds.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

/// The operands of a large union, and what a difference takes away if that is much, stand in groups
/// of some that are alike in size and near each other: a group is a union of operands, or of
/// smaller groups. In a list it is a test like a primitive's, of an index beyond the
/// primitives'. Its extent is a box outside of which none of its operands matters; of nothing is it
/// known to lie inside.
///
/// Left out altogether are operands that reach nowhere where they matter: each operation leaves a
/// box outside of which its operands cannot change the whole.
class OperandGroups {
 public:
  OperandGroups() = default;
  /// `extents`: of the primitives, index for index.
  OperandGroups(const CsgTree& tree, Extents extents);

  /// For the same tree, of whose primitives only `moved` have other extents: groups keep what they
  /// hold, and grow where that reaches further. Null if the groups would have to hold others, or
  /// have grown too often.
  static std::shared_ptr<const OperandGroups> with_moved(
      const std::shared_ptr<const OperandGroups>& earlier, const CsgTree& tree,
      const Extents& extents, std::span<const uint32_t> moved);

  /// The whole tree's. Constant if nothing of it is left.
  const CellList& list() const { return list_; }
  /// Of the primitives, then of the groups.
  const Extents& extents() const { return extents_; }
  /// Indices below are primitives'.
  uint32_t first_group() const { return first_group_; }
  bool is_group(uint32_t index) const { return index >= first_group_; }
  /// How many primitives and groups there are.
  uint32_t count() const { return static_cast<uint32_t>(extents_.size()); }

  /// A group's own list as in a CellList, its numbers counted from its own tests, of which the
  /// last of the arrays is where evaluation starts.
  struct Members {
    std::span<const uint32_t> primitive;  // or group; with kComplementBit
    std::span<const uint32_t> if_inside, if_outside;
    /// Where the first of them stands among the members of all groups.
    uint32_t first;
    uint32_t group;
    /// Each member holds the group, and the next is asked otherwise: any of them may be left out.
    bool is_union;

    /// Where its rows start in an array of row_size() numbers.
    template <typename Number>
    std::array<Number*, 4> rows(Number* numbers) const {
      const size_t count = primitive.size();
      Number* const from = numbers + 4 * size_t{first};
      return {from, from + count, from + 2 * count, from + 3 * count};
    }
  };
  Members members(uint32_t group) const {
    const Range& range = members_[group - first_group_];
    const auto part = [&range](const std::vector<uint32_t>& all) {
      return std::span(all.data() + range.first, range.count);
    };
    return {part(primitive_), part(if_inside_), part(if_outside_), range.first, group,
            range.is_union};
  }
  /// Of all groups together.
  uint32_t member_count() const { return static_cast<uint32_t>(if_inside_.size()); }
  /// Numbers in four rows, of which each group's stand together, and what vectors read past them.
  size_t row_size() const { return 4 * size_t{member_count()} + kRowPadding; }
  /// Balls that hold the group's members, their centres counted from that of its extent, rounded to
  /// float. Side by side they are read much faster than extents, which lie all over memory.
  BallRows balls(uint32_t group) const;
  /// The primitives and groups that stand in no group, or in the tree more than once.
  std::span<const uint32_t> common() const { return common_; }

 private:
  class Builder;
  void place_members(uint32_t group);
  struct Range {
    uint32_t first = 0, count = 0;
    bool is_union = false;  // of members
  };

  CellList list_;
  Extents extents_;
  uint32_t first_group_ = 0;
  uint32_t moved_ = 0;               // primitives that moved since the groups were made
  std::vector<Range> members_;       // by group
  std::vector<uint32_t> primitive_;  // and valid indices that vectors read past the last
  std::vector<uint32_t> if_inside_, if_outside_;
  std::vector<float> balls_;  // of a group's members x, then y, z and radius; then the next group's
  std::vector<uint32_t> common_;
};

}  // namespace csgcore
