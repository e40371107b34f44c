// A scene made ready for subdivision and ray tracing: primitives in canonical form, and a tree
// compiled to a Blist.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "csgcore/blist.hpp"
#include "csgcore/canonical_primitive.hpp"
#include "csgcore/extent.hpp"
#include "csgcore/scene.hpp"
#include "csgcore/scene_edit.hpp"

namespace csgcore {

struct CellList;
class OperandGroups;
struct LeanTree;

/// The canonical primitives of a scene, index for index. Shared by the solids of its trees.
using CanonicalPrimitives = std::vector<CanonicalPrimitive>;
std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene);

/// Those of the scene after an edit, from those before: only added primitives are computed. Bit for
/// bit as if made anew.
std::shared_ptr<const CanonicalPrimitives> canonical_primitives(const Scene& scene,
                                                                const CanonicalPrimitives& earlier,
                                                                const SceneEdit& edit);

/// One tree of a scene, immutable.
class Solid {
 public:
  /// Every index in `tree` must be below primitives->size().
  Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree);

  /// A tree of the scene after an edit, from that before. What holds is shared; drawn, it is bit
  /// for bit as if made anew. `tree_edit` is the tree's own, SceneEdit::model, background or
  /// highlight.
  Solid(std::shared_ptr<const CanonicalPrimitives> primitives, const CsgTree& tree,
        const Solid& earlier, const SceneEdit& edit, TreeEdit tree_edit);

  std::span<const CanonicalPrimitive> primitives() const { return *primitives_; }
  /// Index for index those of `primitives()`; none if the tree is empty.
  std::span<const Extent> extents() const;
  /// The whole tree, as a list that is valid everywhere; without operands that change nothing
  /// (redundant_operands.hpp).
  const Blist& list() const { return list_; }
  /// The primitives that only those operands name: what lies within others, and what equals others.
  std::span<const uint32_t> inner() const;
  std::span<const uint32_t> equal() const;
  /// The same in the form that is restricted to cells and tiles; null if the list is constant.
  const CellList* cell_list() const { return cell_list_.get(); }
  /// The same with operands in groups.
  const OperandGroups& groups() const { return *groups_; }
  /// Box of the solid, by the operations: a union's is the union of its operands' boxes, an
  /// intersection's their intersection, a difference's that of its first operand. Empty if the
  /// solid is.
  const Box& bounds() const { return bounds_; }
  /// Point membership in the closed primitives; on a surface either answer may come.
  bool contains(const Vec3& point) const;

 private:
  /// The one that the list and the groups are made of.
  const CsgTree& used_of(const CsgTree& tree) const;

  std::shared_ptr<const CanonicalPrimitives> primitives_;
  std::shared_ptr<const LeanTree> lean_;  // null: all operands count
  Blist list_;
  std::shared_ptr<const CellList> cell_list_;
  std::shared_ptr<const OperandGroups> groups_;
  Box bounds_;
};

}  // namespace csgcore
