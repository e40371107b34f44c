// Subdivision::update, which follows an edit: only the cells that a changed primitive reaches are
// subdivided anew.
#include <algorithm>
#include <utility>

#include "cells/assembler.hpp"
#include "cells/builder.hpp"
#include "csgcore/subdivision.hpp"
#include "solid/restriction.hpp"

namespace csgcore {
namespace {

/// Subdividing cells that hold more than this share of the tests one by one takes as long as
/// subdividing everything anew.
constexpr double kMostReplacedAtOnce = 1.0 / 3;
/// If replaced leaves would hold more than this share of the stored tests, everything is subdivided
/// anew, which gets rid of them.
constexpr double kMostReplaced = 0.5;
/// Each node is tested against all changes that reach it, so that no more than this share of the
/// primitives may have changed.
constexpr double kMostChanges = 0.02;

/// A primitive before and after the edit; null if it does not exist then.
struct Change {
  const CanonicalPrimitive* before;
  const CanonicalPrimitive* after;
};

std::vector<Change> changes_of(const Solid& before, const Solid& after, const SceneEdit& edit) {
  std::vector<Change> changes;
  if (edit.keeps_indices()) {
    for (const uint32_t i : edit.added) {
      changes.push_back({&before.primitives()[i], &after.primitives()[i]});
    }
    return changes;
  }
  for (const uint32_t i : edit.removed) changes.push_back({&before.primitives()[i], nullptr});
  for (const uint32_t i : edit.added) changes.push_back({nullptr, &after.primitives()[i]});
  return changes;
}

/// Returns whether the change may change the function of the cell.
bool concerns(const Change& change, const Box& cell) {
  const auto place = [&](const CanonicalPrimitive* primitive) {
    return primitive ? classify(*primitive, cell) : Classification::kOutside;
  };
  const Classification before = place(change.before);
  return before == Classification::kCrosses || place(change.after) != before;
}

Box half_of(const Box& box, const KdNode& node, bool above) {
  Box half = box;
  (above ? half.min : half.max)[static_cast<int>(node.axis)] = node.split;
  return half;
}

class Updater {
 public:
  /// Keeps references to all arguments but the overlap.
  Updater(const Solid& solid, const SubdivisionOptions& options, double overlap, Chunk& tree)
      : overlap_(overlap),
        tree_(tree),
        classifier_(solid.primitives()),
        restrictor_(solid.extents(), classifier_),
        builder_(solid, options, overlap, no_sink_),
        is_changed_(tree.nodes.size()) {}

  /// Marks the nodes of leaves that name a removed primitive, and all nodes above them. mark()
  /// finds most of them; but a leaf may name a primitive that classify() finds outside of its cell.
  void mark_gone(const std::vector<uint32_t>& later_indices) {
    // A node has a larger index than its parent.
    for (size_t i = tree_.nodes.size(); i-- > 0;) {
      const KdNode& node = tree_.nodes[i];
      if (node.axis != KdNode::kLeafAxis) {
        is_changed_[i] = is_changed_[node.below] | is_changed_[node.above];
        continue;
      }
      for (const BlistTest& test : tests_of(tree_.leaves[node.below])) {
        if (later_indices[test.primitive] == SceneEdit::kGone) is_changed_[i] = 1;
      }
    }
  }

  /// Marks the nodes above leaves whose functions the changes may change, and the node itself.
  /// Returns whether the node is marked.
  bool mark(uint32_t node, const Box& box, std::span<const Change> changes) {
    const Box cell = inflated(box);
    std::vector<Change> own;
    for (const Change& change : changes) {
      if (concerns(change, cell)) own.push_back(change);
    }
    if (own.empty()) return is_changed_[node] != 0;
    const KdNode& at = tree_.nodes[node];
    bool changed = at.axis == KdNode::kLeafAxis;
    if (!changed) {
      for (const bool above : {false, true}) {
        changed |= mark(above ? at.above : at.below, half_of(box, at, above), own);
      }
    }
    is_changed_[node] |= changed;
    return is_changed_[node] != 0;
  }

  /// Counts of the leaves that are to be replaced, and of their tests.
  struct Count {
    uint64_t leaves = 0, tests = 0;
  };
  Count count() const {
    Count count;
    for (size_t i = 0; i < tree_.nodes.size(); ++i) {
      if (!is_changed_[i] || tree_.nodes[i].axis != KdNode::kLeafAxis) continue;
      ++count.leaves;
      count.tests += tree_.leaves[tree_.nodes[i].below].test_count;
    }
    return count;
  }

  /// Replaces the marked leaves. `tests` is the list of the whole solid. Returns whether the budget
  /// sufficed.
  bool replace_all(const Box& root_box, std::span<const BlistTest> tests) {
    if (!is_changed_[0]) return true;
    CellList whole, list;
    assign(whole, tests);
    restrictor_.restrict(whole, inflated(root_box), list);
    const uint64_t stored_bytes = bytes_of(tree_);
    start(0, root_box, 0, list);
    if (!builder_.can_divide(starts_, stored_bytes)) return false;
    if (!builder_.finish(starts_, stored_bytes)) return false;
    place(std::move(starts_), slots_, tree_);
    return true;
  }

 private:
  Box inflated(const Box& box) const { return {box.min - overlap_, box.max + overlap_}; }

  std::span<const BlistTest> tests_of(const Leaf& leaf) const {
    return std::span(tree_.tests).subspan(leaf.first_test, leaf.test_count);
  }

  /// Starts the subtrees that replace the marked leaves at and below the node. `list` is the
  /// solid's function within the node's cell. The recursion is as deep as the tree.
  void start(uint32_t index, const Box& box, uint32_t depth, const CellList& list) {
    const KdNode& node = tree_.nodes[index];
    if (node.axis == KdNode::kLeafAxis) {
      Leaf& leaf = tree_.leaves[node.below];
      builder_.start(leaf, depth, list, starts_);
      slots_.push_back(index);
      leaf.kind = LeafKind::kReplaced;
      leaf.solid = false;
      return;
    }
    CellList halves[2];
    const Box boxes[2] = {half_of(box, node, false), half_of(box, node, true)};
    if (list.is_constant()) {
      for (CellList& half : halves) half.finish(list.root);
    } else {
      restrictor_.restrict(list, {inflated(boxes[0]), inflated(boxes[1]), node.axis}, halves[0],
                           halves[1]);
    }
    if (is_changed_[node.below]) start(node.below, boxes[0], depth + 1, halves[0]);
    if (is_changed_[node.above]) start(node.above, boxes[1], depth + 1, halves[1]);
  }

  const double overlap_;
  Chunk& tree_;
  const BatchSink no_sink_;
  WorldClassifier classifier_;
  Restrictor restrictor_;
  Builder builder_;
  Chunk starts_;
  std::vector<uint32_t> slots_;      // the nodes that the subtrees of starts_ replace
  std::vector<uint8_t> is_changed_;  // by node of the tree before the edit
};

}  // namespace

SubdivisionUpdate Subdivision::update(const Solid& solid, const SceneEdit& edit,
                                      TreeEdit tree_edit) {
  const Solid& before = *solid_;
  const auto leaves_of_tree = [&] { return (nodes_.size() + 1) / 2; };
  const uint64_t leaves_before = leaves_of_tree();
  const auto all_anew = [&] {
    SubdivisionUpdate result;
    result.is_anew = true;
    result.leaves_replaced = leaves_before;
    *this = Subdivision(solid, options_);
    result.leaves_made = leaves_.size();
    return result;
  };
  const bool has_same_root =
      before.bounds().min == solid.bounds().min && before.bounds().max == solid.bounds().max;
  const double most_changes = std::max(1.0, kMostChanges * edit.primitives_after);
  if (tree_edit == TreeEdit::kAnywhere || !has_same_root || nodes_.empty() ||
      solid.list().tests.empty() || options_.threshold_px > 0 ||
      edit.removed.size() + edit.added.size() > 2 * most_changes) {
    return all_anew();
  }

  Chunk tree;
  tree.nodes = std::move(nodes_);
  tree.leaves = std::move(leaves_);
  tree.tests = std::move(tests_);
  Updater updater(solid, options_, overlap_, tree);
  if (!edit.keeps_indices()) updater.mark_gone(edit.later_indices());
  updater.mark(0, root_box_, changes_of(before, solid, edit));
  const Updater::Count count = updater.count();
  const double stored = static_cast<double>(tree.tests.size());
  if (static_cast<double>(count.tests) > kMostReplacedAtOnce * stored ||
      static_cast<double>(replaced_tests_ + count.tests) > kMostReplaced * stored) {
    return all_anew();
  }

  SubdivisionUpdate result;
  result.first_new_leaf = tree.leaves.size();
  result.first_new_test = tree.tests.size();
  result.leaves_replaced = count.leaves;
  if (!edit.keeps_indices()) {
    const std::vector<uint32_t> later_indices = edit.later_indices();
    for (BlistTest& test : tree.tests) {
      const uint32_t later = later_indices[test.primitive];
      test.primitive = (later == SceneEdit::kGone ? 0 : later) & 0x7FFFFFFFu;
    }
  }
  if (!updater.replace_all(root_box_, solid.list().tests)) return all_anew();
  nodes_ = std::move(tree.nodes);
  leaves_ = std::move(tree.leaves);
  tests_ = std::move(tree.tests);
  solid_ = &solid;
  replaced_tests_ += count.tests;
  result.leaves_made = leaves_.size() - result.first_new_leaf;
  result.leaves_kept = leaves_of_tree() - result.leaves_made;
  return result;
}

}  // namespace csgcore
