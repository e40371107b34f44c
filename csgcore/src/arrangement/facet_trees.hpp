// Trees of boxes over the facets of each operand: which of them may be somewhere, and how often
// they wind around a point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/facet_grid.hpp"

namespace csgcore {

/// A box of the grid in single precision, rounded outwards.
struct FacetBox {
  std::array<float, 3> min;
  std::array<float, 3> max;

  bool meets(const FacetBox& other) const {
    int apart = 0;  // without a branch for each side
    for (size_t i = 0; i < 3; ++i) {
      apart |= static_cast<int>(min[i] > other.max[i]) | static_cast<int>(max[i] < other.min[i]);
    }
    return apart == 0;
  }
  bool holds(const FacetBox& other) const {
    for (size_t i = 0; i < 3; ++i) {
      if (other.min[i] < min[i] || other.max[i] > max[i]) return false;
    }
    return true;
  }
  void merge(const FacetBox& other) {
    for (size_t i = 0; i < 3; ++i) {
      min[i] = std::min(min[i], other.min[i]);
      max[i] = std::max(max[i], other.max[i]);
    }
  }
};

FacetBox box_between(const GridPoint& least, const GridPoint& most);

/// A tree over boxes, which are put into its order.
class BoxTree {
 public:
  /// A node's first child follows it, and then what the child holds; the second child is the node
  /// `after` the first. A leaf's next node is the one after it.
  struct Node {
    FacetBox box;
    uint32_t begin;  // the boxes that it holds
    uint32_t end;
    uint32_t after;
  };

  BoxTree() = default;
  /// Makes the tree, and returns in `order` which box stands at each place.
  BoxTree(std::span<const FacetBox> boxes, std::vector<uint32_t>& order);

  const std::vector<Node>& nodes() const { return nodes_; }
  bool is_leaf(uint32_t node) const { return nodes_[node].after == node + 1; }

  /// Calls visit(begin, end) for the leaves whose boxes, as those of the nodes above them,
  /// `is_wanted` takes, until it returns true. Returns whether it did. It starts at a node.
  template <class IsWanted, class Visit>
  bool visit(IsWanted is_wanted, Visit visit, uint32_t node_number = 0) const {
    const auto end = nodes_.empty() ? 0 : nodes_[node_number].after;
    for (uint32_t i = node_number; i < end;) {
      const Node& node = nodes_[i];
      if (!is_wanted(node.box)) {
        i = node.after;
        continue;
      }
      if (is_leaf(i) && visit(node.begin, node.end)) return true;
      ++i;
    }
    return false;
  }

 private:
  class Builder;

  std::vector<Node> nodes_;
};

/// The trees of all operands' facets.
class FacetTrees {
 public:
  /// Puts the facets of each operand into the order of its tree. Keeps a reference to them.
  FacetTrees(Facets& facets, size_t operands);

  size_t size() const { return trees_.size(); }
  /// The operand's nodes hold facets by their numbers less that of its first.
  const BoxTree& tree(uint32_t operand) const { return trees_[operand]; }
  uint32_t first(uint32_t operand) const { return firsts_[operand]; }
  uint32_t end(uint32_t operand) const { return firsts_[operand + 1]; }
  bool is_empty(uint32_t operand) const { return trees_[operand].nodes().empty(); }
  const FacetBox& box(uint32_t operand) const { return trees_[operand].nodes().front().box; }
  const FacetBox& facet_box(uint32_t facet) const { return boxes_[facet]; }

  /// Returns whether the facet may meet the box. False is right: their boxes are apart, or the box
  /// lies on one side of the facet's plane.
  bool may_meet(uint32_t facet, const FacetBox& box) const {
    return box.meets(boxes_[facet]) &&
           (box.holds(boxes_[facet]) || !is_beside_plane(facets_.corners(facet), box));
  }
  /// Returns whether any of the facets in a node of the operand's tree may meet the box.
  bool meet(uint32_t operand, const FacetBox& box, uint32_t node = 0) const;

  /// Returns how often the operand's facets, but for those that `is_left_out` takes, wind around a
  /// point that is on none of them: one of exact_center.hpp. It looks along the axis.
  template <class Point, class IsLeftOut>
  int winding(uint32_t operand, const Point& point, int axis, IsLeftOut is_left_out) const {
    // The position is rounded by less than a unit.
    const Vec3 at = point.position();
    const auto i = static_cast<size_t>(axis);
    const auto is_ahead = [&](const FacetBox& box) {
      for (size_t j = 0; j < 3; ++j) {
        const double x = at[static_cast<int>(j)];
        if (static_cast<double>(box.max[j]) < x - 1) return false;
        if (j != i && static_cast<double>(box.min[j]) > x + 1) return false;
      }
      return true;
    };
    int result = 0;
    trees_[operand].visit(is_ahead, [&](uint32_t begin, uint32_t end) {
      for (uint32_t facet = begin + first(operand); facet < end + first(operand); ++facet) {
        if (!is_left_out(facet)) result += crossed(facets_.corners(facet), point, axis);
      }
      return false;
    });
    return result;
  }

 private:
  /// Returns whether the box surely lies on one side of the plane through the corners.
  static bool is_beside_plane(const std::array<GridPoint, 3>& corners, const FacetBox& box);

  /// Returns what the way from the point along the axis leaves of the facet's solid: 1 if it passes
  /// the facet from behind, -1 from ahead, 0 if it does not.
  template <class Point>
  static int crossed(const std::array<GridPoint, 3>& corners, const Point& point, int axis) {
    const auto& [a, b, c] = corners;
    const int facing = point.turn(a, b, axis);
    if (point.turn(b, c, axis) != facing || point.turn(c, a, axis) != facing) return 0;
    return point.side(plane_through(a, b, c)) == -facing ? facing : 0;
  }

  std::vector<uint32_t> firsts_;  // by operand, and the end of all
  std::vector<BoxTree> trees_;
  const Facets& facets_;
  std::vector<FacetBox> boxes_;  // by facet
};

}  // namespace csgcore
