#include "arrangement/needed_facets.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "arrangement/disjoint_sets.hpp"
#include "arrangement/exact_center.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

class Selection {
 public:
  Selection(const Facets& facets, const FacetTrees& trees, const Covers& covers,
            const std::vector<bool>& may_cross_itself)
      : facets_(facets),
        trees_(trees),
        covers_(covers),
        decisions_(covers.decisions()),
        may_cross_itself_(may_cross_itself),
        states_(facets.facets.size(), kApart) {}

  NeededFacets run() {
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_for(size_t{0}, trees_.size(), [&](size_t i) {
      const StopScope scope(stop);
      stop_point();
      select(static_cast<uint32_t>(i));
    });
    for (const Facets::Touch& touch : facets_.touches) set_near(touch.facet);
    return patches();
  }

 private:
  enum State : uint8_t { kLeftOut, kApart, kNear };  // kNear: another surface may come near

  NeededFacets patches() const {
    NeededFacets result;
    DisjointSets sets(states_.size());
    std::vector<uint32_t> first_at(facets_.points.size(), kNoPlace);  // of facets that are apart
    for (uint32_t i = 0; i < states_.size(); ++i) {
      if (states_[i] != kApart) continue;
      for (const uint32_t corner : facets_.facets[i].corners) {
        if (first_at[corner] == kNoPlace) first_at[corner] = i;
        sets.join(first_at[corner], i);
      }
    }
    result.first_of.assign(states_.size(), kNoPlace);
    for (uint32_t i = 0; i < states_.size(); ++i) {
      if (states_[i] == kLeftOut) continue;
      result.first_of[i] = sets.find(i);
      if (result.first_of[i] == i) result.firsts.push_back(i);
    }
    return result;
  }

  void set_near(uint32_t facet) {
    if (states_[facet] == kApart) states_[facet] = kNear;
  }

  void select(uint32_t operand) {
    if (trees_.is_empty(operand)) return;
    const FacetBox& box = trees_.box(operand);
    const bool is_apart = decisions_.any_decides_outside(operand, [&](uint32_t other) {
      return other != operand && (trees_.is_empty(other) || !trees_.box(other).meets(box));
    });
    if (is_apart) {
      leave_out(trees_.first(operand), trees_.end(operand));
      return;
    }
    if (may_cross_itself_[operand]) {
      for (uint32_t i = trees_.first(operand); i < trees_.end(operand); ++i) set_near(i);
    }
    std::vector<bool> is_left_out(trees_.tree(operand).nodes().size(), false);
    covers_.visit(box, [&](uint32_t other) {
      if (other != operand) compare(operand, other, is_left_out);
      return false;
    });
  }

  void leave_out(uint32_t begin, uint32_t end) {
    std::fill(states_.begin() + begin, states_.begin() + end, kLeftOut);
  }

  /// An operand beside another one that decides it somewhere.
  struct Comparison {
    uint32_t operand;
    uint32_t other;
    std::vector<bool>& is_left_out;  // by node of the operand: all of its facets are
    std::array<bool, 2> decides;     // the other one, outside of it and inside
    std::vector<uint32_t> near;  // nodes of the other one, those for each node above the last one
    // The last facet that was found to be apart from the other surface, and whether inside of it.
    std::array<uint32_t, 3> last{kNoPlace, kNoPlace, kNoPlace};
    bool is_inside = false;
  };

  /// Leaves out facets of the operand where the other one decides, in groups as large as possible.
  void compare(uint32_t operand, uint32_t other, std::vector<bool>& is_left_out) {
    Comparison at{
        operand,
        other,
        is_left_out,
        {decisions_.decides(other, false, operand), decisions_.decides(other, true, operand)},
        {0}};
    compare(at, 0, 0);
  }

  /// Does so in a node. What comes near the node above it is in at.near from `begin` on. Recurses
  /// as deep as the tree is.
  void compare(Comparison& at, uint32_t number, size_t begin) {
    if (at.is_left_out[number]) return;
    const BoxTree& tree = trees_.tree(at.operand);
    const BoxTree::Node& node = tree.nodes()[number];
    const uint32_t first = trees_.first(at.operand);
    const size_t end = at.near.size();
    for (size_t i = begin; i < end; ++i) add_near(at, at.near[i], node.box);
    if (at.near.size() == end) {
      if (is_decided_apart(at, first + node.begin)) {
        leave_out(first + node.begin, first + node.end);
        at.is_left_out[number] = true;
      }
      return;
    }
    if (tree.is_leaf(number)) {
      for (uint32_t facet = first + node.begin; facet < first + node.end; ++facet) {
        if (states_[facet] == kLeftOut) continue;
        const FacetBox& box = trees_.facet_box(facet);
        const bool is_apart =
            std::none_of(at.near.begin() + static_cast<std::ptrdiff_t>(end), at.near.end(),
                         [&](uint32_t there) { return trees_.meet(at.other, box, there); });
        if (is_apart ? is_decided_apart(at, facet) : at.decides[1] && is_held(at.other, facet)) {
          leave_out(facet, facet + 1);
        } else if (!is_apart) {
          set_near(facet);
        }
      }
    } else {
      compare(at, number + 1, end);
      compare(at, tree.nodes()[number + 1].after, end);
    }
    at.near.resize(end);
  }

  /// Adds what of the other operand's node comes near the box: the node if it is a leaf, or its
  /// children.
  void add_near(Comparison& at, uint32_t number, const FacetBox& box) const {
    const BoxTree& tree = trees_.tree(at.other);
    if (tree.is_leaf(number)) {
      if (trees_.meet(at.other, box, number)) at.near.push_back(number);
      return;
    }
    for (const uint32_t child : {number + 1, tree.nodes()[number + 1].after}) {
      if (tree.nodes()[child].box.meets(box)) at.near.push_back(child);
    }
  }

  /// Returns whether the other operand decides the facet, which is apart from its surface.
  bool is_decided_apart(Comparison& at, uint32_t facet) const {
    if (at.decides[0] == at.decides[1]) return at.decides[0];
    const auto& corners = facets_.facets[facet].corners;
    // Two that share a corner are on one side.
    if (std::ranges::find_first_of(corners, at.last) == corners.end()) {
      const MovedPoint corner(facets_.points[corners[0]]);
      at.is_inside = trees_.winding(at.other, corner, 0, [](uint32_t) { return false; }) != 0;
    }
    at.last = corners;
    return at.decides[at.is_inside ? 1 : 0];
  }

  bool is_held(uint32_t operand, uint32_t facet) const {
    if (!trees_.box(operand).holds(trees_.facet_box(facet))) return false;
    const auto [a, b, c] = facets_.corners(facet);
    const std::array corners{to_vec3(a), to_vec3(b), to_vec3(c)};
    return covers_.hold(operand, corners);
  }

  const Facets& facets_;
  const FacetTrees& trees_;
  const Covers& covers_;
  const Decisions& decisions_;
  const std::vector<bool>& may_cross_itself_;
  std::vector<State> states_;  // by facet; bytes, since several threads write them
};

}  // namespace

NeededFacets needed_facets(const Facets& facets, const FacetTrees& trees, const Covers& covers,
                           const std::vector<bool>& may_cross_itself) {
  return Selection(facets, trees, covers, may_cross_itself).run();
}

}  // namespace csgcore
