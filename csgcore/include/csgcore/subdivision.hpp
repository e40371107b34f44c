// Spatial subdivision (paper §2): a kd-tree whose leaf cells hold the few primitives that matter
// there.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "csgcore/short_circuit_list.hpp"
#include "csgcore/solid.hpp"
#include "csgcore/view.hpp"

namespace csgcore {

enum class SplitRule : uint8_t {
  kCyclic,       // paper §2.1: in the middle, along x, y, z in turn
  kSurfaceArea,  // the axis and position of least Σ area · primitives
};

struct SubdivisionOptions {
  /// K: a cell is a leaf once the surfaces of at most so many distinct primitives cross it. ≥ 1.
  uint32_t leaf_primitives = 8;
  /// Paper §2.2 case 2: a cell that is a union of primitives, of any number, is a leaf.
  bool stop_at_unions = false;
  /// Paper §2.2 case 4: a cell that projects to fewer pixels in `view` is dropped. 0: none is.
  double threshold_px = 0;
  /// Must be set if threshold_px > 0; not used otherwise.
  std::optional<View> view;
  SplitRule split = SplitRule::kSurfaceArea;
  /// How many bytes the cells may take: what is left to divide when they are used up is given up
  /// (LeafKind::kGivenUp). Bounds the time, too. 0: subdivision_budget() of the solid's literals.
  uint64_t budget_bytes = 0;
  /// Worker threads; 0: as many as there are. The result does not depend on it.
  unsigned threads = 0;

  /// The paper's own rule: K = 2, unions of any number, middle splits.
  static SubdivisionOptions paper(double threshold_px, const View& view);
};

enum class LeafKind : uint8_t {
  kEmpty,    // case 1: no surface crosses the cell
  kUnion,    // case 2: one primitive, or the union of several
  kPair,     // case 3: an intersection of two, complemented or not
  kGeneral,  // up to K primitives, any function
  kFull,  // more than K that no sensible subdivision separates (they coincide, meet in a point, or
          // lie so close that dividing repeats more than it separates): evaluated in full
  kDropped,   // case 4: below the threshold
  kGivenUp,   // more than K; not divided since the budget is used up; evaluated in full
  kReplaced,  // no part of the tree any longer: others stand in its place (refine, update)
};
constexpr size_t kLeafKinds = 8;

/// `literals` of Subdivision [first_literal, first_literal + literal_count) are the cell's
/// function.
struct Leaf {
  Box box;
  uint64_t first_literal = 0;
  uint32_t literal_count = 0;
  LeafKind kind = LeafKind::kEmpty;
  bool solid = false;  // kEmpty: the cell lies within the solid
};

/// axis 0, 1, 2: the cells below and above `split` are the nodes `below` and `above`.
/// axis kLeafAxis: `below` is the index of the leaf.
struct KdNode {
  static constexpr uint32_t kLeafAxis = 3;
  double split = 0;
  uint32_t axis = kLeafAxis;
  uint32_t below = 0;
  uint32_t above = 0;
};

/// Leaves that one piece of the subdivision has finished, with the literals they index. In the
/// places of those that are kReplaced others will come.
struct LeafBatch {
  std::span<const Leaf> leaves;
  std::span<const Literal> literals;
};

/// Called with each batch as the subdivision delivers it (paper §2.3, "render the CSG object while
/// subdividing it"), from any thread, one call at a time; the spans live during the call only.
using BatchSink = std::function<void(const LeafBatch&)>;

/// The budget of a solid of so many literals, in bytes: 64 MiB and in proportion to them, at most
/// 2 GiB. Ordinary designs need a tenth of it.
uint64_t subdivision_budget(size_t literals);

/// How far beyond a cell its function is valid (Subdivision::overlap), for a solid of these bounds.
double cell_overlap(const Box& solid_bounds);

/// What Subdivision::update did.
struct SubdivisionUpdate {
  /// All was subdivided anew. Otherwise leaves and literals up to these indices are what they were,
  /// but for leaves that are kReplaced now, and for the indices of primitives; the rest is new.
  bool is_anew = false;
  size_t first_new_leaf = 0;
  size_t first_new_literal = 0;
  uint64_t leaves_kept = 0;
  uint64_t leaves_replaced = 0;
  uint64_t leaves_made = 0;
};

/// The finished kd-tree. nodes[0] is the root; empty if the solid is.
class Subdivision {
 public:
  /// The solid must outlive the subdivision.
  Subdivision(const Solid& solid, SubdivisionOptions options, const BatchSink& sink = {});

  const Solid& solid() const { return *solid_; }
  const SubdivisionOptions& options() const { return options_; }
  std::span<const KdNode> nodes() const { return nodes_; }
  std::span<const Leaf> leaves() const { return leaves_; }
  std::span<const Literal> literals() const { return literals_; }
  std::span<const Literal> literals_of(const Leaf& leaf) const {
    return literals().subspan(leaf.first_literal, leaf.literal_count);
  }
  const Box& root_box() const { return root_box_; }
  size_t bytes() const;

  /// Paper §2.3: subdivides on where cells that were dropped for the old view exceed the threshold
  /// in the new one. Returns whether anything changed. Leaves keep their indices. The budget is
  /// that of all views together: what it does not suffice for is drawn, but not divided.
  bool refine(const View& view);

  /// Follows an edit: `solid` is of the scene after it, that of this subdivision of the same tree
  /// before; both must live. `tree_edit` is that tree's (SceneEdit::model, background, highlight).
  /// Leaves are kept whose cells lie wholly inside or wholly outside of every changed primitive's
  /// old and new form alike; others are subdivided anew, each for itself. Where that is too little
  /// to be worth it all is subdivided anew: where the root box changes, the cells that change hold
  /// more than a third of the literals, more than half of what is stored has been replaced by and
  /// by, the budget does not suffice for what is added, or cells are dropped below a threshold.
  SubdivisionUpdate update(const Solid& solid, const SceneEdit& edit, TreeEdit tree_edit);

  /// The leaf that holds the point (of several that share it, one); nullptr outside the root box.
  const Leaf* find(const Vec3& point) const;

  /// How far, in world units, each cell's function is valid beyond the cell itself: an overlap that
  /// absorbs the float rounding of a renderer's cell boundaries.
  double overlap() const { return overlap_; }

 private:
  const Solid* solid_;
  SubdivisionOptions options_;
  Box root_box_;
  double overlap_ = 0;
  std::vector<KdNode> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<Literal> literals_;
  uint64_t replaced_literals_ = 0;  // of leaves that update() has replaced
};

/// Leaf counts by kind.
struct LeafCensus {
  uint64_t by_kind[kLeafKinds] = {};
  uint64_t literals = 0;
  uint64_t leaves() const;  // all that the tree still has: kReplaced is not counted
};
LeafCensus census(const Subdivision& subdivision);

}  // namespace csgcore
