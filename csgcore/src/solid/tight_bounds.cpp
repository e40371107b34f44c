// The search for a side of the box is best first: of all cells that may hold a part of the solid,
// the one that reaches farthest is divided next, and what is proven empty is dropped. So the
// farthest cell bounds the solid at any time, and the search ends where a point of the solid is
// found next to that bound, where the cell is as small as the accuracy, or where the budget ends.
//
// Cells are classified without a margin at their sides, each half the thickness tolerance: what
// lies between two empty cells is then thinner than the tolerance. Without it, no cell on the joint
// of two flush operands would ever be proven to lie within their union.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/geometry.hpp"
#include "csgcore/solid.hpp"
#include "solid/contraction.hpp"
#include "solid/restriction.hpp"
#include "tree/cell_list.hpp"
#include "tree/subtree_boxes.hpp"

namespace csgcore {
namespace {

/// A share of the box's largest side that is a fraction of a pixel in any picture of all of it.
constexpr double kAccuracy = 0x1p-13;
/// The accuracy stays this many times above the margin of cells, which would be too coarse else.
constexpr double kLeastMargins = 4;

bool is_union(const CsgTree& tree) {
  return std::ranges::all_of(tree.tokens(), [](const CsgToken& token) {
    return token.is_primitive || token.op == Op::kUnion;
  });
}

/// A side of the box: the largest or the least coordinate along an axis.
struct BoxSide {
  int axis;
  bool is_upper;

  /// Returns how far the coordinate reaches outwards.
  double reach(double coordinate) const { return is_upper ? coordinate : -coordinate; }
  double coordinate(const Box& box) const { return (is_upper ? box.max : box.min)[axis]; }
  double reach(const Box& box) const { return reach(coordinate(box)); }
};

class BoundsSearch {
 public:
  BoundsSearch(std::span<const CanonicalPrimitive> primitives, const Extents& extents,
               double margin, BoundsBudget& budget)
      : primitives_(primitives),
        classifier_(primitives),
        restrictor_(extents, classifier_),
        contractor_(primitives, margin),
        margin_(margin),
        budget_(budget) {}

  Box run(const CellList& whole, Box box) {
    double size_before;
    do {
      size_before = largest(box.size());
      accuracy_ = std::max(kAccuracy * size_before, kLeastMargins * margin_);
      CellList list;
      if (!restrict(whole, box, list)) return {};
      for (int i = 0; i < 6; ++i) {
        const BoxSide side{i / 2, i % 2 == 0};
        budget_left_after_ = budget_.tests - budget_.tests / static_cast<uint64_t>(6 - i);
        const std::optional<double> reach = find(side, list, box);
        if (!reach) return {};
        (side.is_upper ? box.max : box.min)[side.axis] = side.reach(*reach);
      }
      // What is left may be far smaller than the operands, which the accuracy was a share of.
    } while (largest(box.size()) < 0.5 * size_before);
    return box;
  }

 private:
  struct Cell {
    double reach;
    uint32_t number;  // in order of creation
    Box box;
    CellList list;
    bool is_contracted = false;
    Vec3 tip, middle;  // a point that reaches as far, and one in the middle of what is below it

    /// Of equal ones the youngest comes first: so the search soon gets to small cells.
    bool operator<(const Cell& other) const {
      return reach != other.reach ? reach < other.reach : number < other.number;
    }
  };

  /// Returns how far the solid reaches; nothing if it has no part in the box.
  std::optional<double> find(const BoxSide& side, const CellList& whole, const Box& box) {
    cells_.clear();
    uint32_t count = 0;
    const auto add = [&](const CellList& list, const Box& part) {
      Cell cell{0, count++, part, {}, false, {}, {}};
      if (!restrict(list, part, cell.list) || !contract(side, cell)) return;
      cell.reach = side.reach(cell.box);
      cells_.push_back(std::move(cell));
      std::push_heap(cells_.begin(), cells_.end());
    };
    add(whole, box);
    double found = reach_of_operands(side, whole, box);  // how far a point of it reaches
    while (!cells_.empty()) {
      std::pop_heap(cells_.begin(), cells_.end());
      const Cell cell = std::move(cells_.back());
      cells_.pop_back();
      found = std::max(found, reach_of_point(side, cell));
      if (cell.reach - found <= accuracy_ || budget_.tests <= budget_left_after_) return cell.reach;
      const std::optional<int> axis = axis_of_division(side, cell);
      if (!axis) return cell.reach;
      const double plane = plane_of_division(cell, *axis);
      Box below = cell.box, above = cell.box;
      below.max[*axis] = above.min[*axis] = plane;
      add(cell.list, below);
      add(cell.list, above);
    }
    return std::nullopt;
  }

  /// Returns how far the solid certainly reaches by points of the operands that bound the box: most
  /// solids keep a corner of these, or the middle between corners.
  double reach_of_operands(const BoxSide& side, const CellList& list, const Box& box) const {
    constexpr uint32_t kMostAsked = 64;
    constexpr uint32_t kMostTests = 1 << 14;  // of all points: to ask for one may take them all
    constexpr double kTilt = 1e-3;     // finds the corners of a face that lies in the box's side
    constexpr double kInwards = 1e-6;  // so that rounding does not decide: a share of the way in
    const uint32_t most = std::clamp(kMostTests / (5 * list.count() + 1), 1u, kMostAsked);
    uint32_t asked = 0;
    for (const uint32_t entry : list.primitives()) {
      if ((entry & CellList::kComplementBit) != 0) continue;
      const CanonicalPrimitive& operand = primitives_[entry & kPrimitiveBits];
      if (std::abs(side.reach(operand.bounds) - side.reach(box)) > accuracy_) continue;
      if (++asked > most) break;
      Vec3 sum(0.0);
      for (int corner = 0; corner <= 4; ++corner) {
        Vec3 direction(0.0);
        direction[side.axis] = side.is_upper ? 1 : -1;
        direction[(side.axis + 1) % 3] = (corner & 1) ? kTilt : -kTilt;
        direction[(side.axis + 2) % 3] = (corner & 2) ? kTilt : -kTilt;
        const Vec3 outer = corner < 4 ? furthest_point(operand, direction) : 0.25 * sum;
        sum += outer;
        const Vec3 point = outer + kInwards * (operand.center - outer);
        if (holds(list, point)) return side.reach(point[side.axis]);
      }
    }
    return -std::numeric_limits<double>::infinity();
  }

  /// Returns whether the cell may hold a part of the solid.
  bool restrict(const CellList& list, const Box& cell, CellList& result) {
    const Box inner{cell.min + Vec3(margin_), cell.max - Vec3(margin_)};
    if (inner.empty()) return false;
    if (list.is_constant()) {
      result = list;
    } else {
      spend(list.count());
      restrictor_.restrict(list, inner, result);
    }
    return result.root != CellList::kFalse;
  }

  /// Returns whether the cell still may hold a part of the solid.
  bool contract(const BoxSide& side, Cell& cell) {
    cell.middle = cell.tip = cell.box.center();
    cell.tip[side.axis] = side.coordinate(cell.box);
    if (cell.list.is_constant() || cell.list.count() > Contractor::kMostTests) return true;
    constexpr uint64_t kTestsEach = 16;  // takes as long
    spend(kTestsEach * cell.list.count());
    Vec3 outwards(0.0);
    outwards[side.axis] = side.is_upper ? 1 : -1;
    const Vec3 margin(margin_);
    const std::optional<Contraction> held =
        contractor_.contract(cell.list, {cell.box.min + margin, cell.box.max - margin}, outwards);
    if (!held) return false;
    cell.tip = held->tip;
    cell.middle = held->middle;
    // A side that stays where it is stays exact.
    for (int axis = 0; axis < 3; ++axis) {
      const double low = held->box.min[axis] - margin_;
      const double high = held->box.max[axis] + margin_;
      cell.is_contracted =
          cell.is_contracted || low > cell.box.min[axis] || high < cell.box.max[axis];
      cell.box.min[axis] = std::max(cell.box.min[axis], low);
      cell.box.max[axis] = std::min(cell.box.max[axis], high);
    }
    return true;
  }

  void spend(uint64_t tests) { budget_.tests -= std::min(budget_.tests, tests); }

  /// Returns how far the solid certainly reaches in the cell, if a point next to its tip lies in
  /// it.
  double reach_of_point(const BoxSide& side, const Cell& cell) const {
    const double height = cell.reach - side.reach(cell.middle[side.axis]);
    const double depth = 0.5 * std::min(height, accuracy_);
    const Vec3 point = cell.tip + (depth / height) * (cell.middle - cell.tip);
    return holds(cell.list, point) ? side.reach(point[side.axis])
                                   : -std::numeric_limits<double>::infinity();
  }

  bool holds(const CellList& list, const Vec3& point) const {
    uint32_t number = list.root;
    while (number >= CellList::kFirst) {
      const uint32_t i = number - CellList::kFirst;
      const bool is_inside =
          csgcore::contains(primitives_[list.primitive[i] & kPrimitiveBits], point);
      number = is_inside ? list.if_inside[i] : list.if_outside[i];
    }
    return number == CellList::kTrue;
  }

  /// Returns the axis along which most surfaces follow one another, since dividing a cell along a
  /// prism's axis leads to nothing; of equal ones the longest. Nothing if the cell is too small.
  std::optional<int> axis_of_division(const BoxSide& side, const Cell& cell) {
    constexpr uint32_t kMostTests = 64;    // with more of them any division leads on
    constexpr double kThickness = 0x1p-6;  // of the rods along the axes that are tried, as a share
    // The cell's part that reaches farthest comes next, so that it is divided off as flat as this
    // share of its width; where contraction flattens cells, less of that is better.
    constexpr double kFlatness = 64, kFlatnessOfContracted = 4;
    const Vec3 size = cell.box.size();
    Vec3 weight = size;
    weight[side.axis] *= cell.is_contracted ? kFlatnessOfContracted : kFlatness;
    std::optional<int> best;
    uint32_t most = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (size[axis] <= accuracy_) continue;
      uint32_t count = 0;
      if (!cell.is_contracted && cell.list.count() <= kMostTests) {
        Vec3 half = 0.5 * kThickness * size;
        half[axis] = 0.5 * size[axis];
        spend(cell.list.count());
        restrictor_.restrict(cell.list, {cell.box.center() - half, cell.box.center() + half}, rod_);
        count = rod_.count();
      }
      if (!best || count > most || (count == most && weight[axis] > weight[*best])) {
        best = axis;
        most = count;
      }
    }
    return best;
  }

  /// Returns the end of a primitive's box that is nearest to the cell's middle, or the middle: a
  /// plane face that is divided at is decided on both sides.
  double plane_of_division(const Cell& cell, int axis) const {
    const double middle = cell.box.center()[axis];
    double nearest = 0.5 * cell.box.size()[axis] - kLeastMargins * margin_;
    double plane = middle;
    for (const uint32_t entry : cell.list.primitives()) {
      const Box& bounds = primitives_[entry & kPrimitiveBits].bounds;
      for (const double end : {bounds.min[axis], bounds.max[axis]}) {
        const double distance = std::abs(end - middle);
        if (distance >= nearest) continue;
        nearest = distance;
        plane = end;
      }
    }
    return plane;
  }

  std::span<const CanonicalPrimitive> primitives_;
  WorldClassifier classifier_;
  Restrictor restrictor_;
  const Contractor contractor_;
  const double margin_;
  BoundsBudget& budget_;
  uint64_t budget_left_after_ = 0;  // the side that is searched
  double accuracy_ = 0;
  std::vector<Cell> cells_;  // a heap
  CellList rod_;
};

}  // namespace

Box tight_bounds(std::span<const CanonicalPrimitive> primitives, const CsgTree& tree,
                 BoundsBudget& budget) {
  if (tree.empty()) return {};
  const Box bounds =
      subtree_boxes(tree.tokens(), [&](uint32_t i) { return primitives[i].bounds; }).back();
  if (bounds.empty() || is_union(tree) || budget.tests == 0) return bounds;
  Extents extents(primitives.size());
  for (size_t i = 0; i < extents.size(); ++i) extents[i] = extent_of(primitives[i]);
  CellList whole;
  assign(whole, compile(tree).tests);
  return BoundsSearch(primitives, extents, 0.5 * thickness_tolerance(bounds), budget)
      .run(whole, bounds);
}

}  // namespace csgcore
