// The leaves of OpenSCAD's preview (frontend/OPENSCAD.md, "Leaves"): what it draws as one mesh. A
// leaf is a primitive, or it is compound: a node such as render(), which OpenSCAD evaluates as a
// whole. The operations of a design act on its leaves, so that trees over leaves decide about
// colours, cut faces, layers and the view box; how a leaf is made of primitives does not show.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/csg_tree.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/primitive.hpp"
#include "solids/csg_subtrees.hpp"

namespace frontend {

/// A CSG tree whose tokens name leaves in place of primitives.
using LeafTree = csgcore::CsgTree;

/// All leaves of a design. A leaf below the number of primitives is that primitive; the compound
/// ones follow.
class Leaves {
 public:
  explicit Leaves(uint32_t primitive_count) : primitive_count_(primitive_count) {}

  /// Adds a compound leaf. `frame` is the index of the frame (FrameTree) in which OpenSCAD makes
  /// it; `box` is its box in the world, if it is known.
  uint32_t add(csgcore::CsgTree solid, uint32_t frame,
               const std::optional<csgcore::Box>& box = std::nullopt);

  bool is_compound(uint32_t leaf) const { return leaf >= primitive_count_; }
  /// All leaves, of both kinds.
  uint32_t size() const { return primitive_count_ + static_cast<uint32_t>(compound_.size()); }
  bool has_compound() const { return !compound_.empty(); }
  /// Precondition of these: the leaf is compound.
  const csgcore::CsgTree& solid(uint32_t leaf) const {
    return compound_[leaf - primitive_count_].solid;
  }
  uint32_t frame(uint32_t leaf) const { return compound_[leaf - primitive_count_].frame; }
  const std::optional<csgcore::Box>& box(uint32_t leaf) const {
    return compound_[leaf - primitive_count_].box;
  }
  /// A primitive of the leaf. All of a leaf have the same colour.
  uint32_t first_primitive(uint32_t leaf) const;

  /// The same solid as a tree over primitives.
  csgcore::CsgTree expanded(LeafTree tree) const;

 private:
  struct Compound {
    csgcore::CsgTree solid;
    uint32_t frame;
    std::optional<csgcore::Box> box;
  };
  uint32_t primitive_count_;
  std::vector<Compound> compound_;
};

/// The tree without what boxes tell is empty: an intersection of disjoint boxes, and subtracted
/// operands whose box misses what they are subtracted from. OpenSCAD leaves these out. `boxes`
/// holds the boxes of all leaves, in world space.
LeafTree pruned(const LeafTree& tree, std::span<const csgcore::Box> boxes);

/// A leaf as an operand of the tree's operations.
struct LeafUse {
  uint32_t leaf;
  bool is_subtracted;  // under an odd number of subtractions
  /// The boxes of the operands that the leaf stands with leave something of it: OpenSCAD drops it
  /// otherwise.
  bool meets_others;
};

/// The leaves of the tree, in its order. `boxes` holds the boxes of all leaves, in world space.
std::vector<LeafUse> uses_of_leaves(const LeafTree& tree, std::span<const csgcore::Box> boxes);

/// The union of the boxes of the leaves that are not subtracted and meet the others: what
/// OpenSCAD's
/// --viewall looks at of a tree.
csgcore::Box box_of_positive_leaves(const LeafTree& tree, std::span<const csgcore::Box> boxes);

}  // namespace frontend
