#include "arrangement/needed_facets.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "arrangement/exact_center.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

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
  Decisions(std::span<const CsgToken> tokens, size_t operands)
      : leaf_of_(operands, kNowhere), decided_(operands), parent_of_(tokens.size(), kNowhere) {
    std::vector<size_t> begin_of(tokens.size());
    std::vector<bool> is_first(tokens.size(), false);
    std::vector<size_t> open;  // subtrees that no operation has taken
    for (size_t i = 0; i < tokens.size(); ++i) {
      begin_of[i] = i;
      if (!tokens[i].is_primitive) {
        const size_t first = open.size() - tokens[i].value;
        begin_of[i] = begin_of[open[first]];
        is_first[open[first]] = true;
        for (size_t j = first; j < open.size(); ++j) parent_of_[open[j]] = i;
        open.resize(first);
      }
      open.push_back(i);
    }
    // By token and its value: the largest subtree that has one value wherever it has that.
    std::vector<std::array<size_t, 2>> largest(tokens.size());
    for (size_t i = tokens.size(); i-- > 0;) {
      for (const bool value : {false, true}) {
        largest[i][value ? 1 : 0] = i;
        if (parent_of_[i] == kNowhere) continue;
        const Op op = tokens[parent_of_[i]].op;
        const bool is_subtracted = op == Op::kDifference && !is_first[i];
        if (value != (op == Op::kUnion || is_subtracted)) continue;
        const bool parent_value = op == Op::kUnion;
        largest[i][value ? 1 : 0] = largest[parent_of_[i]][parent_value ? 1 : 0];
      }
    }
    outside_at_.resize(tokens.size());
    std::vector<bool> is_known(operands, false);
    for (size_t i = 0; i < tokens.size(); ++i) {
      if (!tokens[i].is_primitive) continue;
      const uint32_t operand = tokens[i].value;
      // What the tree has twice is not judged.
      leaf_of_[operand] = is_known[operand] ? kNowhere : i;
      is_known[operand] = true;
    }
    for (uint32_t operand = 0; operand < operands; ++operand) {
      const size_t leaf = leaf_of_[operand];
      if (leaf == kNowhere) continue;
      for (const size_t value : {0u, 1u}) {
        const size_t node = largest[leaf][value];
        if (node == leaf) continue;
        decided_[operand][value] = {begin_of[node], node + 1};
        if (value == 0) outside_at_[node].push_back(operand);
      }
    }
  }

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

class Selection {
 public:
  Selection(const Facets& facets, const FacetTrees& trees, std::span<const CsgToken> tokens)
      : facets_(facets),
        trees_(trees),
        decisions_(tokens, trees.size()),
        is_needed_(facets.facets.size(), 1) {
    std::vector<FacetBox> boxes;
    for (uint32_t i = 0; i < trees.size(); ++i) {
      if (trees.is_empty(i)) continue;
      placed_.push_back(i);
      boxes.push_back(trees.box(i));
    }
    std::vector<uint32_t> order;
    operands_ = BoxTree(boxes, order);
    for (uint32_t& place : order) place = placed_[place];
    placed_ = std::move(order);
  }

  std::vector<uint32_t> run() {
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_for(size_t{0}, trees_.size(), [&](size_t i) {
      const StopScope scope(stop);
      stop_point();
      select(static_cast<uint32_t>(i));
    });
    std::vector<uint32_t> result;
    result.reserve(static_cast<size_t>(std::ranges::count(is_needed_, 1)));
    for (uint32_t i = 0; i < is_needed_.size(); ++i) {
      if (is_needed_[i] != 0) result.push_back(i);
    }
    return result;
  }

 private:
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
    operands_.visit([&](const FacetBox& other) { return other.meets(box); },
                    [&](uint32_t begin, uint32_t end) {
                      for (uint32_t i = begin; i < end; ++i) compare(operand, placed_[i]);
                      return false;
                    });
  }

  void leave_out(uint32_t begin, uint32_t end) {
    std::fill(is_needed_.begin() + begin, is_needed_.begin() + end, uint8_t{0});
  }

  /// Leaves out facets of the operand where the other one decides, in groups as large as possible.
  void compare(uint32_t operand, uint32_t other) {
    const std::array<bool, 2> decides{decisions_.decides(other, false, operand),
                                      decisions_.decides(other, true, operand)};
    if (operand == other || (!decides[0] && !decides[1])) return;
    // The last facet that was found to be apart from the other surface, and whether inside of it.
    std::array<uint32_t, 3> last{kNoPlace, kNoPlace, kNoPlace};
    bool is_inside = false;
    // The facet is one of those in the box.
    const auto is_decided = [&](const FacetBox& box, uint32_t facet) {
      if (!trees_.box(other).meets(box)) return decides[0];
      if (trees_.meet(other, box)) return false;
      const auto& corners = facets_.facets[facet].corners;
      // Two that share a corner are on one side.
      if (std::ranges::find_first_of(corners, last) == corners.end()) {
        const MovedPoint corner(facets_.points[corners[0]]);
        is_inside = trees_.winding(other, corner, 0, [](uint32_t) { return false; }) != 0;
      }
      last = corners;
      return decides[is_inside ? 1 : 0];
    };
    const BoxTree& tree = trees_.tree(operand);
    const uint32_t first = trees_.first(operand);
    for (uint32_t i = 0; i < tree.nodes().size();) {
      const auto& [box, begin, end, after] = tree.nodes()[i];
      if (is_decided(box, first + begin)) {
        leave_out(first + begin, first + end);
        i = after;
        continue;
      }
      for (uint32_t facet = first + begin; tree.is_leaf(i) && facet < first + end; ++facet) {
        if (is_needed_[facet] == 0) continue;
        if (is_decided(trees_.facet_box(facet), facet)) leave_out(facet, facet + 1);
      }
      ++i;
    }
  }

  const Facets& facets_;
  const FacetTrees& trees_;
  Decisions decisions_;
  std::vector<uint8_t> is_needed_;  // by facet; bytes, since several threads write them
  BoxTree operands_;
  std::vector<uint32_t> placed_;  // operands in the order of that tree
};

}  // namespace

std::vector<uint32_t> needed_facets(const Facets& facets, const FacetTrees& trees,
                                    std::span<const CsgToken> tokens) {
  return Selection(facets, trees, tokens).run();
}

}  // namespace csgcore
