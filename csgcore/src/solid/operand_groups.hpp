// The operand BVH: a solid's list with its operands in nested groups, which are expanded only where
// their operands matter.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/csg_tree.hpp"
#include "solid/extent_tests.hpp"
#include "tree/cell_list.hpp"

namespace csgcore {

/// The operands of a large union, and those that a difference subtracts if they are many, are put
/// into groups of operands that are alike in size and near each other. A group is a union of
/// operands or of smaller groups; the groups form a BVH (bounding volume hierarchy). In a list a
/// group is a test like a primitive's, with an index above those of primitives. Its extent is a box
/// outside of which none of its operands matters, and never claims that a cell lies inside the
/// group. To expand a group is to replace its test by those of its members.
///
/// Operands that reach nowhere where they matter are left out: each operation has a box outside of
/// which its operands cannot change the solid.
class OperandGroups {
 public:
  OperandGroups() = default;
  /// `extents` are those of the primitives, with the same indices.
  OperandGroups(const CsgTree& tree, Extents extents);

  /// The list of the whole tree. It is constant if no operand is left.
  const CellList& list() const { return list_; }
  /// The extents of the primitives, then those of the groups.
  const Extents& extents() const { return extents_; }
  /// The first index of a group; those below are primitives.
  uint32_t first_group() const { return first_group_; }
  bool is_group(uint32_t index) const { return index >= first_group_; }
  /// The number of primitives and groups together.
  uint32_t count() const { return static_cast<uint32_t>(extents_.size()); }

  /// A group's own list, as in a CellList: numbers refer to the group's own tests, and the last
  /// entry of the arrays is where evaluation starts.
  struct Members {
    std::span<const uint32_t> primitive;  // the index of a primitive or group; with kComplementBit
    std::span<const uint32_t> if_inside, if_outside;
    /// The position of the first member among the members of all groups.
    uint32_t first;
    uint32_t group;
    /// The group is true where a member is true, and goes on to the next member otherwise. So
    /// members may be left out without renumbering.
    bool is_union;

    /// Returns the group's four rows in an array of row_size() numbers.
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
  /// The number of members of all groups.
  uint32_t member_count() const { return static_cast<uint32_t>(if_inside_.size()); }
  /// The size of an array with four rows for each group, one group after the other, and the padding
  /// that vectors read.
  size_t row_size() const { return 4 * size_t{member_count()} + kRowPadding; }
  /// Balls around the group's members, in float, with centres relative to the centre of the group's
  /// extent. They lie side by side (SoA), and so are read much faster than extents, which are
  /// scattered in memory.
  BallRows balls(uint32_t group) const;
  /// The primitives and groups that the whole list names, or that more than one test names.
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
  std::vector<Range> members_;       // by group
  std::vector<uint32_t> primitive_;  // of all groups; then valid indices as the vectors' padding
  std::vector<uint32_t> if_inside_, if_outside_;
  std::vector<float> balls_;  // by group: the members' x, then y, z and radius
  std::vector<uint32_t> common_;
};

}  // namespace csgcore
